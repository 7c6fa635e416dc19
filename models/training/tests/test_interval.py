"""The interval around an answer: NumPy only."""

import numpy as np
import pytest

from prvnet import interval


def skewed(rng, objects, shoots=1):
    """Errors that stay the same for an object, mostly, and are lopsided."""
    return rng.gamma(2.0, 4.0, (objects, 1)) - 5 + rng.normal(0, 1, (objects, shoots))


@pytest.mark.parametrize("objects", [30, 140])
def test_the_stated_share_of_new_labels_lies_inside(objects):
    rng = np.random.default_rng(0)
    shares = []
    for _ in range(300):
        low, high = interval.offsets(skewed(rng, objects, 6))
        new = skewed(rng, 100)
        shares.append(np.mean((low <= new) & (new <= high)))
    assert interval.LEVEL - 0.01 < np.mean(shares) < interval.LEVEL + 0.05


def test_a_lopsided_error_gives_a_lopsided_interval_around_zero():
    low, high = interval.offsets(skewed(np.random.default_rng(1), 400))
    assert low < 0 < high and high > 1.5 * -low
    # Answers that are all too low still lie in their own interval.
    assert interval.offsets(np.full((50, 2), 3.0)) == (0.0, 3.0)


def test_too_few_objects_give_their_extremes():
    assert interval.offsets([[-3.0], [1.0], [4.0]]) == (-3.0, 4.0)


def test_whole_numbers_hold_exactly_the_labels_within_the_offsets():
    rng = np.random.default_rng(2)
    for answer in rng.uniform(12, 60, 200):
        low, high = interval.bounds(answer, -7.3, 9.9)
        labels = np.arange(1, 201)
        inside = labels[(answer - 7.3 <= labels) & (labels <= answer + 9.9)]
        assert (low, high) == (inside[0], inside[-1])


def test_the_rounded_answer_is_inside_and_the_ends_are_numbers_of_views():
    assert interval.bounds(30.4, -0.2, 0.1) == (30, 30)
    assert interval.bounds(3.0, -20.0, 2.0) == (1, 5)
    assert interval.bounds(198.0, -1.5, 30.0) == (197, 200)


def test_a_share_comes_with_its_own_uncertainty():
    assert interval.share_with_interval(28, 35) == "80 % [64, 90]"
