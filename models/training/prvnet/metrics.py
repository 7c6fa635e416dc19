"""Errors in views, with how sure they are."""

import numpy as np


def l1(predicted, labels) -> float:
    return float(np.mean(np.abs(np.asarray(predicted) - np.asarray(labels))))


def bootstrap(errors, groups, draws=2000, seed=0) -> tuple[float, float]:
    """95 % interval of the mean of `errors`, drawing whole objects (`groups`) with replacement."""
    errors, groups = np.asarray(errors, float), np.asarray(groups)
    names = np.unique(groups)
    sums = np.array([errors[groups == name].sum() for name in names])
    counts = np.array([(groups == name).sum() for name in names])
    rng = np.random.default_rng(seed)
    picks = rng.integers(0, len(names), (draws, len(names)))
    means = sums[picks].sum(1) / counts[picks].sum(1)
    low, high = np.quantile(means, [0.025, 0.975])
    return float(low), float(high)


def with_interval(errors, groups) -> str:
    low, high = bootstrap(errors, groups)
    return f"{np.mean(errors):.2f} [{low:.2f}, {high:.2f}]"
