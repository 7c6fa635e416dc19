"""What the novelty says of photos that are like those trained on, and of photos that are not."""

import numpy as np

from .augment import Scene
from .onnx_model import OnnxModel

SETS = 12


def strange_photos(clean, rng) -> dict[str, list[np.ndarray]]:
    """Photo sets [1 or 3, 3, S, S] by name that no lab wants a number for, partly made of `clean` sets [n, 3, S, S]."""
    side = clean[0].shape[-1]
    blank = np.ones((3, 3, side, side), np.float32)

    def backgrounds(seed):
        scene = Scene(np.random.default_rng(seed))
        return np.stack([scene.background(side, rng).transpose(2, 0, 1) for _ in range(3)])

    def blocks(cells):
        coarse = rng.random((3, 3, cells, cells))
        return coarse.repeat(-(-side // cells), 2).repeat(-(-side // cells), 3)[..., :side, :side]

    def zoomed(photos, factor=3):
        start, size = side // 2 - side // (2 * factor), -(-side // factor)
        part = photos[:3, :, start : start + size, start : start + size]
        return part.repeat(factor, 2).repeat(factor, 3)[..., :side, :side]

    few = clean[:SETS]
    fine = [rng.random((3, 3, side, side)) for _ in range(SETS)]
    coarse = [blocks(side // 8) for _ in range(SETS)]
    return {
        "noise, pixel by pixel": fine,
        "noise, pixel by pixel, 1 photo": [photos[:1] for photos in fine],
        "noise, in blocks": coarse,
        "noise, in blocks, 1 photo": [photos[:1] for photos in coarse],
        "grey all over": [0.5 * blank],
        "black all over": [0 * blank],
        "white all over": [blank],
        "backgrounds without object": [backgrounds(seed) for seed in range(SETS)],
        "held-out objects, three times enlarged": [zoomed(photos) for photos in few],
        "held-out objects, in negative": [1 - photos[:3] for photos in few],
        "held-out objects, a tenth as bright": [0.1 * photos[:3] for photos in few],
    }


def lines(model: OnnxModel, clean, shoots_novelty) -> list[str]:
    """A Markdown table: median novelty, and the share above 1."""
    rng = np.random.default_rng(0)
    table = {f"held-out objects, {n} clean photo{'s' * (n > 1)}": [model.answer(p[:n])[1] for p in clean] for n in (3, 1)}
    table["held-out objects, random backgrounds, light and camera"] = np.asarray(shoots_novelty).ravel()
    for name, sets in strange_photos(clean, rng).items():
        table[name] = [model.answer(np.clip(photos, 0, 1))[1] for photos in sets]
    return ["| photos | sets | median novelty | above 1 |", "|---|---|---|---|"] + [
        f"| {name} | {len(scores)} | {np.median(scores):.2f} | {100 * np.mean(np.asarray(scores) > 1):.0f} % |"
        for name, scores in table.items()
    ]
