"""A linear head on a frozen encoder's features, solved instead of trained.

Ridge regression (Hoerl and Kennard, Technometrics 12, 1970) of the view count on the leading principal components of
the features. The components are those of the objects' mean features, so directions in which only light and
backgrounds differ are left out; the samples are random shoots with random numbers of photos, so what those still move
costs the fit. The penalty is chosen by cross-validation over objects.
"""

import numpy as np
import torch

from . import INITIAL_IMAGES, MAX_IMAGES
from .model import mean_and_variance, twice_if_single
from .splits import fold_of

COMPONENTS = 300
# Penalties, relative to the number of samples.
PENALTIES = (0.3, 1.0, 3.0, 10.0, 30.0)
# How much the variances over the photos count against the means: with one photo they are zero, with two mostly noise.
VARIANCE_SHARES = (0.1, 0.3, 1.0)
FOLDS = 5
# Features that hardly vary are not blown up.
LEAST_SPREAD = 1e-5


def samples(source, rows, variants: int, seed: int) -> np.ndarray:
    """[rows, 2 variants, 2 D] means and variances: of each shoot the three initial photos, and a random choice of the five."""
    rng, first, table = np.random.default_rng(seed), list(range(INITIAL_IMAGES)), []
    for row in rows:
        each = []
        for variant in range(variants):
            chosen = rng.permutation(MAX_IMAGES)[: rng.integers(1, MAX_IMAGES + 1)].tolist()
            each += [mean_and_variance(twice_if_single(source.batch([(row, variant, images)]))) for images in (first, chosen)]
        table.append(torch.cat(each).numpy())
    return np.stack(table)


class Ridge:
    """One choice of the variances' share, to be solved with any penalty."""

    def __init__(self, table: np.ndarray, views: np.ndarray, groups, variance_share: float):
        """`table` of standardised samples, the rows' labels, and the objects that cross-validation goes by."""
        self.views = np.asarray(views, float)
        self.fold = np.array([fold_of("ridge " + group) % FOLDS for group in groups])
        share = np.ones(table.shape[2])
        share[share.size // 2 :] = variance_share
        means = table.mean(1) * share
        means -= means.mean(0)
        values, vectors = np.linalg.eigh(means @ means.T)
        kept = max(1, min(COMPONENTS, len(means) - 1))
        values, vectors = values[::-1][:kept], vectors[:, ::-1][:, :kept]
        self.components = share[:, None] * (means.T @ vectors) / np.sqrt(np.maximum(values, 1e-9))
        self.inside = table @ self.components

    def _solve(self, rows: np.ndarray, penalty: float):
        x = self.inside[rows].reshape(-1, self.inside.shape[2])
        y = np.repeat(self.views[rows], self.inside.shape[1])
        middle, offset = x.mean(0), y.mean()
        x = x - middle
        weights = np.linalg.solve(x.T @ x + penalty * len(x) * np.eye(x.shape[1]), x.T @ (y - offset))
        return weights, offset - middle @ weights

    def error(self, penalty: float) -> float:
        """L1 on objects left out fold by fold, views."""
        errors = []
        for fold in sorted(set(self.fold)):
            out = self.fold == fold
            if out.all():
                return 0.0
            weights, offset = self._solve(~out, penalty)
            known = self.views[~out]
            answers = np.clip(self.inside[out] @ weights + offset, known.min(), known.max())
            errors.append(np.abs(answers - self.views[out, None]).mean(1))
        return float(np.concatenate(errors).mean())

    def weights(self, penalty: float) -> tuple[np.ndarray, float]:
        """Weights [2 D] and an offset on standardised features."""
        weights, offset = self._solve(np.ones(len(self.views), bool), penalty)
        return self.components @ weights, float(offset)


def solve(table: np.ndarray, views: np.ndarray, groups) -> tuple[np.ndarray, float]:
    """`Ridge.weights` with the share and the penalty of the least error on objects left out."""
    best = None
    for share in VARIANCE_SHARES:
        ridge = Ridge(table, views, groups, share)
        error, penalty = min((ridge.error(penalty), penalty) for penalty in PENALTIES)
        if best is None or error < best[0]:
            best = error, ridge, penalty
    _, ridge, penalty = best
    return ridge.weights(penalty)


def fit(network, source, rows, config: dict):
    """Solves the network's one linear head for `rows`; `source` gives features."""
    table = samples(source, rows, config["variants"], config["seed"])
    means = table.mean(1)
    head, middle, spread = network.heads[0], means.mean(0), means.std(0) + LEAST_SPREAD
    table = ((table - middle) / spread).clip(-head.LIMIT, head.LIMIT)
    weights, offset = solve(table, np.array([row.views for row in rows]), [row.group for row in rows])
    with torch.no_grad():
        head.middle.copy_(torch.from_numpy(middle))
        head.spread.copy_(torch.from_numpy(spread))
        head.weight.copy_(torch.from_numpy(weights)[None])
        head.bias.fill_(offset)
