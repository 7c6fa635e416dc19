"""Intervals around a predicted count that hold a stated share of labels.

Conformal: the ends are quantiles of the errors on objects that the network answering was not trained on (cross-
conformal prediction: Vovk, Annals of Mathematics and Artificial Intelligence 74, 2015). Each side is calibrated for
itself, since labels above the answer are further off than those below.
"""

import math

import numpy as np

# Share of labels inside the interval.
LEVEL = 0.8

# The service's least and largest number of views.
COUNTS = (1, 200)


def offsets(residuals, level: float = LEVEL) -> tuple[float, float]:
    """(low, high), low <= 0 <= high: what to add to an answer for its interval's ends.

    `residuals` is [objects, answers]: label less answer, for several answers (shoots) of each object. The rank allows
    for the number of objects; too few of them for the level give their extremes.
    """
    residuals = np.asarray(residuals, float)
    share = min(1.0, math.ceil((len(residuals) + 1) * (1 + level) / 2) / len(residuals))

    def upper(values) -> float:
        ordered = np.sort(values.ravel())
        return float(ordered[max(0, math.ceil(share * len(ordered) - 1e-9) - 1)])

    return min(0.0, -upper(-residuals)), max(0.0, upper(residuals))


def bounds(answer: float, low: float, high: float) -> tuple[int, int]:
    """The whole numbers within the offsets of `answer`, and at least the rounded answer itself; as the service does."""
    rounded = min(max(math.floor(answer + 0.5), COUNTS[0]), COUNTS[1])
    return (
        min(max(math.ceil(answer + low), COUNTS[0]), rounded),
        max(min(math.floor(answer + high), COUNTS[1]), rounded),
    )


def share_with_interval(inside: int, of: int) -> str:
    """A share in per cent with its 95 % interval (Wilson, Journal of the American Statistical Association 22, 1927)."""
    z, p = 1.96, inside / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z / (1 + z * z / of) * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return f"{100 * p:.0f} % [{100 * (middle - half):.0f}, {100 * (middle + half):.0f}]"
