"""How unlike the objects trained on the given photos are: 1 is what one in a hundred of their own shoots exceeds.

The score is the larger of two. One is the part of the photos' features outside of the leading principal components of
those trained on. The other is how far they are on the way from photos with an object to photos of the same scenes
without one, which random backgrounds put inside of those components. Objects and empty scenes are shot before surfaces
too (`surfaces.py`), which no network learnt from, so that an object on a table of wood is no stranger than one on white.
Only the features of early stages count: they tell
noise, blank, torn and out-of-scale photos from photos of things, which the last layer, made to tell kinds of things
apart, does not.
"""

from pathlib import Path

import numpy as np
import torch
from torch import nn
from tqdm import tqdm

from . import MAX_IMAGES, augment, surfaces
from .sources import Photos, shoot_seed
from .splits import fold_of

# With 32, noise in a single photo was as near to objects as a hundredth of their own photos are; negatives and dark
# photos, which lie inside of what further components span, stood out more (0.96 against 0.86, 0.79 against 0.67).
COMPONENTS = 192
FOLDS = 5
# Left-out shoots that score above 1.
EXCEEDING = 0.01
# Features have heavy tails: asinh(STEEPNESS z) makes far outliers count as their logarithm.
STEEPNESS = 3.0
# Shoots of each row, the first of them clean, besides the one before surfaces.
SHOOTS = 2
# Shoots of scenes without an object, every second before surfaces; the penalty of the regression that tells them from the others, as a share of the
# features' mean square.
EMPTY_SHOOTS = 400
EMPTY_PENALTY = 0.3
# Two images whose standardised features differ by less are one that was fed twice.
SAME = 1e-3


def early_features(encoder) -> int:
    """How many of the encoder's features, from the first, come from stages before its last layer; all if none do."""
    net = encoder.net
    last = net._conv_head.out_channels if hasattr(net, "_conv_head") else net.num_features
    return encoder.dim - last if encoder.levels == "all" else encoder.dim


def squashed(x):
    """asinh, which the exporter's opset lacks."""
    return x.sign() * torch.log(x.abs() + torch.sqrt(x * x + 1))


def photos_before_surfaces(crops: np.ndarray, seed: list[int]) -> np.ndarray:
    """[5, 3, S, S] of one shoot of crops [5, S, S, 4] of bytes."""
    return surfaces.shoot(crops, np.random.default_rng([0x5F, *seed])).transpose(0, 3, 1, 2)


def empty_photos(size: int, shoot: int) -> np.ndarray:
    """[5, 3, size, size] of one shoot of a scene that lacks its object."""
    nothing = np.zeros((MAX_IMAGES, size, size, 4), np.uint8)
    if shoot % 2:
        return photos_before_surfaces(nothing, [shoot])
    return augment.shoot(nothing, np.random.default_rng([0xE3, shoot])).transpose(0, 3, 1, 2)


class Novelty(nn.Module):
    """Features [n, D] of one object's n photos to a score [1]."""

    BUFFERS = ("middle", "spread", "center", "deviation", "components", "emptiness", "offset", "scale", "empty_scale")

    def __init__(self, fitted: dict):
        super().__init__()
        for name in self.BUFFERS:
            self.register_buffer(name, torch.from_numpy(np.asarray(fitted[name], np.float32)))

    def standardised(self, mean):
        return (squashed(STEEPNESS * (mean - self.middle) / self.spread) - self.center) / self.deviation

    def outside(self, mean):
        """[b, D] means over the photos to [b] mean squared deviations outside of the components."""
        z = self.standardised(mean)
        inside = z @ self.components.T
        return ((z * z).sum(1) - (inside * inside).sum(1)).clamp(min=0) / z.shape[1]

    def empty(self, mean):
        """[b, D] means over the photos to [b]: 0 where they are as the average object's, 2 where as an empty scene's."""
        return (self.standardised(mean) @ self.emptiness + self.offset).clamp(min=0)

    def forward(self, features):
        early = features[:, : self.middle.shape[0]]
        # Fewer photos vary more: each number of them has scales of its own.
        twice = ((early[0] - early[1]) / self.spread).abs().max() < SAME
        count = torch.ones_like(early[:, 0]).sum().clamp(max=MAX_IMAGES)
        count = torch.where(twice & (count == 2), torch.ones_like(count), count)
        mean, count = early.mean(0, keepdim=True), count.long()
        outside = self.outside(mean) / self.scale[count].reshape(1)
        return torch.maximum(outside, self.empty(mean) / self.empty_scale[count].reshape(1))


def _subspace(means: np.ndarray, empty: np.ndarray) -> dict:
    """Middle, spread and components of [m, D] means, and the direction from them to those of empty scenes [e, D]."""
    middle, spread = np.median(means, 0), means.std(0) + 1e-6

    def squash(x):
        return np.arcsinh(STEEPNESS * (x - middle) / spread)

    x = squash(means)
    center, deviation = x.mean(0), x.std(0) + 1e-6
    z, z_empty = (((each - center) / deviation).astype(np.float32) for each in (x, squash(empty)))
    square = (z.T @ z).astype(np.float64)
    _, vectors = np.linalg.eigh(square)
    kept = max(1, min(COMPONENTS, len(means) // 4, z.shape[1] // 4))
    emptiness, offset = _emptiness(square / len(z), z_empty.astype(np.float64))
    return {"middle": middle, "spread": spread, "center": center, "deviation": deviation,
            "components": vectors[:, ::-1][:, :kept].T, "emptiness": emptiness, "offset": offset,
            "scale": np.ones(MAX_IMAGES + 1), "empty_scale": np.ones(MAX_IMAGES + 1)}  # fmt: skip


def _emptiness(square: np.ndarray, z_empty: np.ndarray) -> tuple[np.ndarray, float]:
    """Direction [D] and offset of the ridge regression from -1 (objects, of mean 0 and mean square `square`) to 1 (empty
    scenes), both kinds weighing as much; plus 1."""
    middle = z_empty.mean(0) / 2
    spread = (square + z_empty.T @ z_empty / len(z_empty)) / 2 - np.outer(middle, middle)
    penalty = EMPTY_PENALTY * np.trace(spread) / len(spread)
    direction = np.linalg.solve(spread + penalty * np.eye(len(spread)), middle)
    return direction, 1 - float(middle @ direction)


def fit(features: np.ndarray, groups, empty: np.ndarray, seed: int = 0) -> Novelty:
    """From early features [rows, shoots, 5, D] of rows whose objects are `groups`, and [scenes, 5, D] of empty scenes.

    The components are those of single photos: what tells an object's top from its front is nothing new, however few there
    are. The scales come from objects left out fold by fold: scores of theirs at each number of photos, drawn at random.
    """
    rng = np.random.default_rng(seed)

    def means(rows, count):
        chosen = np.argsort(rng.random((len(rows), features.shape[1], MAX_IMAGES)), 2)[..., :count, None]
        return np.take_along_axis(features[rows], chosen, 2).mean(2).reshape(-1, features.shape[3])

    empty = empty.reshape(-1, empty.shape[-1])
    fold = np.array([fold_of("novelty " + group) % FOLDS for group in groups])
    everything = np.arange(len(features))
    scores = [[] for _ in range(MAX_IMAGES)]
    for left_out in range(FOLDS):
        known, others = everything[fold != left_out], everything[fold == left_out]
        if not len(known) or not len(others):
            continue
        part = Novelty(_subspace(means(known, 1), empty))
        for count in range(1, MAX_IMAGES + 1):
            of_others = torch.from_numpy(means(others, count))
            scores[count - 1].append(np.stack([part.outside(of_others).numpy(), part.empty(of_others).numpy()]))
    fitted = _subspace(means(everything, 1), empty)
    for count, each in enumerate(scores, 1):
        fitted["scale"][count], fitted["empty_scale"][count] = _scales(np.concatenate(each, 1))
    return Novelty(fitted)


def fit_to_shoots(features, inputs: Path, rows, size: int) -> Novelty:
    """The score of photos whose early features [5, D] are `features` of [5, 3, size, size], fitted to shoots of `rows` and
    of scenes without an object."""
    table = []
    for row in tqdm(rows, "novelty"):
        photos = Photos(inputs, [row], size)
        shoots = [photos.get(row, variant).numpy() for variant in range(SHOOTS)]
        shoots.append(photos_before_surfaces(photos.crops[row.id][0], shoot_seed(row, 0)))
        table.append(np.stack([features(each) for each in shoots]))
    empty = [features(empty_photos(size, shoot)) for shoot in tqdm(range(EMPTY_SHOOTS), "empty scenes")]
    return fit(np.stack(table), [row.group for row in rows], np.stack(empty))


def _scales(scores: np.ndarray) -> np.ndarray:
    """Scales of two kinds of scores [2, n] that equally many exceed, one in a hundred either of them."""
    each = np.quantile(scores, 1 - EXCEEDING / 2, axis=1)
    return each * np.quantile((scores / each[:, None]).max(0), 1 - EXCEEDING)
