"""Where a training step's batch comes from: photos made anew, or features of a frozen encoder made once."""

import hashlib
import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import torch
from PIL import Image
from tqdm import tqdm

from . import MAX_IMAGES, augment, labels
from .files import whole


def resized(crops: np.ndarray, size: int) -> np.ndarray:
    """Crops [n, S, S, 4] at another size, if they are not written at it already."""
    if crops.shape[1] == size:
        return crops
    images = [Image.fromarray(crop).convert("RGBa").resize((size, size), Image.Resampling.BOX) for crop in crops]
    return np.stack([np.asarray(image.convert("RGBA")) for image in images])


def planes(images: np.ndarray) -> torch.Tensor:
    """[n, S, S, 3] to [n, 3, S, S]."""
    return torch.from_numpy(np.ascontiguousarray(images.transpose(0, 3, 1, 2)))


def shoot_seed(row, variant: int) -> list[int]:
    return [variant, int.from_bytes(hashlib.sha256(row.id.encode()).digest()[:8], "big")]


# Shoots below this number are of the crops themselves: what networks are judged and chosen by.
PLAIN_VARIANTS = 64


class Photos:
    """Variant 0 of a row is its crops on white, every other number a random shoot of them.

    From PLAIN_VARIANTS on a shoot may be of the object's mirror image, or of the object as the folders `turned` have it
    (`prv inputs --yaw-deg`, the same rows): it needs as many views.
    """

    def __init__(self, inputs: Path, rows, size: int, turned: Sequence[Path] = ()):
        self.size = size
        bar = tqdm(rows, "crops", leave=False, disable=len(rows) == 1)
        self.crops = {row.id: [resized(labels.crops(folder, row), size) for folder in (inputs, *turned)] for row in bar}

    def get(self, row, variant: int, images=slice(None)) -> torch.Tensor:
        """[5, 3, S, S] in 0..1, or those of the photos named."""
        sides = self.crops[row.id]
        if variant < PLAIN_VARIANTS:
            crops = sides[0][images]
        else:
            which, mirrored = variant // 2 % len(sides), variant % 2
            crops = sides[which][images, :, :: -1 if mirrored else 1]
        if variant == 0:
            return planes(np.stack([augment.on_white(crop) for crop in crops]))
        return planes(augment.shoot(crops, np.random.default_rng(shoot_seed(row, variant))))

    def batch(self, items) -> torch.Tensor:
        """(row, variant, images) triples to [B, n, 3, S, S]."""
        return torch.stack([self.get(row, variant, images) for row, variant, images in items])


class Bank:
    """Features of a frozen encoder for `variants` shoots of each row, kept on disk row by row."""

    def __init__(self, directory: Path, inputs: Path, rows, network, variants: int, device):
        self.variants = variants
        config = network.config
        name = json.dumps([config["encoder"], config["levels"], config["size"], variants, config.get("encoder_weights")])
        # Another augmentation or encoder code makes other features.
        code = b"".join(Path(__file__).with_name(f"{m}.py").read_bytes() for m in ("augment", "encoders"))
        folder = directory / hashlib.sha256(name.encode() + code).hexdigest()[:12]
        folder.mkdir(parents=True, exist_ok=True)
        self.features = {}
        network.encoder.eval()
        for row in tqdm(rows, "features"):
            path = folder / f"{row.id}.npy"
            if not path.is_file():
                photos = Photos(inputs, [row], config["size"])
                with torch.no_grad():
                    table = [network.encode(photos.batch([(row, v, slice(None))]).to(device))[0] for v in range(variants)]
                with whole(path) as partial, open(partial, "wb") as file:
                    np.save(file, torch.stack(table).cpu().numpy().astype(np.float32))
            self.features[row.id] = torch.from_numpy(np.load(path))

    def batch(self, items) -> torch.Tensor:
        """(row, variant, images) triples to [B, n, D]."""
        return torch.stack([self.features[row.id][variant % self.variants][images] for row, variant, images in items])


def all_subsets(count: int) -> list[list[int]]:
    """Every choice of `count` of the five photos."""
    from itertools import combinations

    return [list(choice) for choice in combinations(range(MAX_IMAGES), count)]
