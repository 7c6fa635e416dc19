"""How unlike the objects trained on the given photos are: 1 is what one in a hundred of their own shoots exceeds.

The score is the part of the photos' features outside of the leading principal components of those trained on. Only
the features of early stages count: they tell noise, blank, torn and out-of-scale photos from photos of things, which
the last layer, made to tell kinds of things apart, does not.
"""

import numpy as np
import torch
from torch import nn

from . import MAX_IMAGES
from .splits import fold_of

# With 32, noise in a single photo was as near to objects as a hundredth of their own photos are; negatives and dark
# photos, which lie inside of what further components span, stood out more (0.96 against 0.86, 0.79 against 0.67).
COMPONENTS = 192
FOLDS = 5
# Left-out shoots that score above 1.
EXCEEDING = 0.01
# Features have heavy tails: asinh(STEEPNESS z) makes far outliers count as their logarithm.
STEEPNESS = 3.0
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


class Novelty(nn.Module):
    """Features [n, D] of one object's n photos to a score [1]."""

    def __init__(self, fitted: dict):
        super().__init__()
        for name in ("middle", "spread", "center", "deviation", "components", "scale"):
            self.register_buffer(name, torch.from_numpy(np.asarray(fitted[name], np.float32)))

    def outside(self, mean):
        """[b, D] means over the photos to [b] mean squared deviations outside of the components."""
        z = (squashed(STEEPNESS * (mean - self.middle) / self.spread) - self.center) / self.deviation
        inside = z @ self.components.T
        return ((z * z).sum(1) - (inside * inside).sum(1)).clamp(min=0) / z.shape[1]

    def forward(self, features):
        early = features[:, : self.middle.shape[0]]
        # Fewer photos vary more: each number of them has a scale of its own.
        twice = ((early[0] - early[1]) / self.spread).abs().max() < SAME
        count = torch.ones_like(early[:, 0]).sum().clamp(max=MAX_IMAGES)
        count = torch.where(twice & (count == 2), torch.ones_like(count), count)
        return self.outside(early.mean(0, keepdim=True)) / self.scale[count.long()].reshape(1)


def _subspace(means: np.ndarray) -> dict:
    """Middle, spread and components of [m, D] means."""
    middle, spread = np.median(means, 0), means.std(0) + 1e-6
    x = np.arcsinh(STEEPNESS * (means - middle) / spread)
    center, deviation = x.mean(0), x.std(0) + 1e-6
    z = ((x - center) / deviation).astype(np.float32)
    _, vectors = np.linalg.eigh((z.T @ z).astype(np.float64))
    kept = max(1, min(COMPONENTS, len(means) // 4, z.shape[1] // 4))
    return {"middle": middle, "spread": spread, "center": center, "deviation": deviation,
            "components": vectors[:, ::-1][:, :kept].T, "scale": np.ones(MAX_IMAGES + 1)}  # fmt: skip


def fit(features: np.ndarray, groups, seed: int = 0) -> Novelty:
    """From early features [rows, shoots, 5, D] of rows whose objects are `groups`.

    The components are those of single photos: what tells an object's top from its front is nothing new, however few there
    are. The scale comes from objects left out fold by fold: scores of theirs at each number of photos, drawn at random.
    """
    rng = np.random.default_rng(seed)

    def means(rows, count):
        chosen = np.argsort(rng.random((len(rows), features.shape[1], MAX_IMAGES)), 2)[..., :count, None]
        return np.take_along_axis(features[rows], chosen, 2).mean(2).reshape(-1, features.shape[3])

    fold = np.array([fold_of("novelty " + group) % FOLDS for group in groups])
    everything = np.arange(len(features))
    scores = [[] for _ in range(MAX_IMAGES)]
    for left_out in range(FOLDS):
        known, others = everything[fold != left_out], everything[fold == left_out]
        if not len(known) or not len(others):
            continue
        part = Novelty(_subspace(means(known, 1)))
        for count in range(1, MAX_IMAGES + 1):
            scores[count - 1].append(part.outside(torch.from_numpy(means(others, count))).numpy())
    fitted = _subspace(means(everything, 1))
    fitted["scale"][1:] = [np.quantile(np.concatenate(each), 1 - EXCEEDING) for each in scores]
    return Novelty(fitted)
