"""A linear head on a frozen encoder's features, solved instead of trained.

Ridge regression (Hoerl and Kennard, Technometrics 12, 1970) of the view count on the leading principal components of
the features. The components are those of the objects' mean features, so directions in which only light and
backgrounds differ are left out; the samples are random shoots with random numbers of photos, so what those still move
costs the fit. Penalty and share of the variances are chosen by cross-validation over objects (components and scale
are of all of them, which only that choice sees).
"""

import math

import numpy as np
import torch

from . import INITIAL_IMAGES, MAX_IMAGES
from .model import mean_and_variance, twice_if_single
from .splits import fold_of

COMPONENTS = 300
# Relative to the number of samples.
PENALTIES = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0)
# How much the variances over the photos count against the means: with one photo they are zero, with two mostly noise.
VARIANCE_SHARES = (0.1, 0.3, 1.0)
FOLDS = 5
# Features that hardly vary are not blown up.
LEAST_SPREAD = 1e-5


def samples(source, rows, config: dict) -> torch.Tensor:
    """[rows, k, 2 D] means and variances: of each shoot the three initial photos and, unless the network is only made
    for those, a random choice of the five."""
    rng, first, table = np.random.default_rng(config["seed"]), list(range(INITIAL_IMAGES)), []
    for row in rows:
        items = []
        for variant in range(config["variants"]):
            items.append((row, variant, first))
            if config["images"] != "3":
                items.append((row, variant, rng.permutation(MAX_IMAGES)[: rng.integers(1, MAX_IMAGES + 1)].tolist()))
        table.append(torch.cat([mean_and_variance(twice_if_single(source.batch([item]))) for item in items]))
    return torch.stack(table)


class Ridge:
    """One choice of the variances' share, to be solved with any penalty."""

    def __init__(self, table: torch.Tensor, views: torch.Tensor, folds: torch.Tensor, variance_share: float):
        """`table` of standardised samples, the rows' labels, and their folds for cross-validation."""
        self.views, self.folds = views, folds
        share = torch.ones(table.shape[2])
        share[len(share) // 2 :] = variance_share
        means = (table.mean(1) * share).double()
        means -= means.mean(0)
        values, vectors = torch.linalg.eigh(means @ means.T)
        kept = max(1, min(COMPONENTS, len(means) - 1))
        values, vectors = values[-kept:], vectors[:, -kept:]
        self.components = share.double()[:, None] * (means.T @ vectors) / values.clamp(min=1e-9).sqrt()
        self.inside = (table @ self.components.float()).double()

    def _solve(self, rows: torch.Tensor, penalty: float):
        x = self.inside[rows].flatten(0, 1)
        y = self.views[rows].repeat_interleave(self.inside.shape[1])
        middle, offset = x.mean(0), y.mean()
        x = x - middle
        weights = torch.linalg.solve(x.T @ x + penalty * len(x) * torch.eye(x.shape[1]), x.T @ (y - offset))
        return weights, offset - middle @ weights

    def error(self, penalty: float) -> float:
        """L1 on objects left out fold by fold, views."""
        errors = []
        for fold in self.folds.unique():
            out = self.folds == fold
            if out.all():
                return math.inf
            weights, offset = self._solve(~out, penalty)
            known = self.views[~out]
            answers = (self.inside[out] @ weights + offset).clamp(known.min(), known.max())
            errors.append((answers - self.views[out, None]).abs().mean(1))
        return float(torch.cat(errors).mean())

    def weights(self, penalty: float) -> tuple[torch.Tensor, float]:
        """Weights [2 D] and an offset on standardised features."""
        weights, offset = self._solve(torch.ones(len(self.views), dtype=torch.bool), penalty)
        return self.components @ weights, float(offset)


def solve(table: torch.Tensor, views: torch.Tensor, folds: torch.Tensor) -> tuple[torch.Tensor, float]:
    """`Ridge.weights` with the share and the penalty of the least error on objects left out; the strongest of equals."""
    best = None
    for share in VARIANCE_SHARES:
        ridge = Ridge(table, views, folds, share)
        error, penalty = min((ridge.error(penalty), -penalty) for penalty in PENALTIES)
        if best is None or error < best[0]:
            best = error, ridge, -penalty
    _, ridge, penalty = best
    return ridge.weights(penalty)


@torch.no_grad()
def fit(network, source, rows, config: dict):
    """Solves the network's one linear head for `rows`; `source` gives features."""
    table = samples(source, rows, config)
    head, means = network.heads[0], table.mean(1)
    head.middle.copy_(means.mean(0))
    head.spread.copy_(means.std(0) + LEAST_SPREAD)
    views = torch.tensor([row.views for row in rows], dtype=torch.float64)
    folds = torch.tensor([fold_of("ridge " + row.group) % FOLDS for row in rows])
    weights, offset = solve(head.standardised(table.to(head.middle.device)).cpu(), views, folds)
    head.weight.copy_(weights[None])
    head.bias.fill_(offset)
