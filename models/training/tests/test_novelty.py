"""How unlike the objects trained on photos are."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

from prvnet import novelty, surfaces  # noqa: E402

DIM, RANK = 60, 5


def features(rng, mixing, rows, shoots=8):
    """Few causes, an object's own and a shoot's, behind many features, some with heavy tails."""
    causes = rng.normal(size=(rows, 1, 1, RANK)) + 0.4 * rng.normal(size=(rows, shoots, 5, RANK))
    noise = 0.2 * rng.standard_t(3, (rows, shoots, 5, DIM))
    return (causes @ mixing + noise).astype(np.float32)


def empty_scenes(rng, mixing, scenes):
    """The same causes behind them, one of them stronger than objects have it: nothing is outside of the components."""
    causes = 0.5 * rng.normal(size=(scenes, 5, RANK)) + 2.8 * np.eye(RANK)[0]
    return (causes @ mixing + 0.2 * rng.standard_t(3, (scenes, 5, DIM))).astype(np.float32)


@pytest.fixture(scope="module")
def known():
    rng = np.random.default_rng(0)
    mixing = rng.normal(size=(RANK, DIM))
    score = novelty.fit(features(rng, mixing, 120), [f"object-{k}" for k in range(120)], empty_scenes(rng, mixing, 100)).eval()
    return score, mixing


def scores(score, table):
    with torch.no_grad():
        return np.array([float(score(torch.from_numpy(photos))[0]) for row in table for photos in row])


@pytest.mark.parametrize("photos", [2, 3, 5])
def test_one_in_a_hundred_of_new_objects_shoots_scores_above_one(known, photos):
    score, mixing = known
    new = features(np.random.default_rng(1), mixing, 60)[:, :, :photos]
    assert np.mean(scores(score, new) > 1) < 0.05


def test_a_single_photo_fed_twice_is_judged_as_one(known):
    score, mixing = known
    new = features(np.random.default_rng(2), mixing, 60)
    twice = np.repeat(new[:, :, :1], 2, axis=2)
    assert np.mean(scores(score, twice) > 1) < 0.05
    assert score.scale[1] > score.scale[2] > score.scale[5]


def test_other_causes_behind_the_same_spread_are_novel(known):
    score, _ = known
    rng = np.random.default_rng(3)
    assert np.mean(scores(score, features(rng, rng.normal(size=(RANK, DIM)), 20)[:, :, :3]) > 1) > 0.95


def test_the_same_data_gives_the_same_score(known):
    _, mixing = known
    table = features(np.random.default_rng(4), mixing, 30)
    empty = empty_scenes(np.random.default_rng(5), mixing, 20)
    first, second = (novelty.fit(table, [str(k) for k in range(30)], empty) for _ in range(2))
    assert all(torch.equal(a, b) for a, b in zip(first.state_dict().values(), second.state_dict().values()))


@pytest.mark.parametrize("photos", [2, 3, 5])
def test_empty_scenes_are_told_apart_although_their_features_are_no_further_off(known, photos):
    score, mixing = known
    new = empty_scenes(np.random.default_rng(6), mixing, 50)[None, :, :photos]
    assert np.mean(scores(score, new) > 1) > 0.95
    outside = score.outside(torch.from_numpy(new[0].mean(1))) / score.scale[photos]
    assert float(outside.median()) < 1


def test_a_scene_without_its_object_is_a_background_in_the_light_of_its_shoot():
    first, again, other = novelty.empty_photos(32, 1), novelty.empty_photos(32, 1), novelty.empty_photos(32, 2)
    assert first.shape == (5, 3, 32, 32) and np.array_equal(first, again) and not np.array_equal(first, other)
    assert first.min() >= 0 and first.max() <= 1


def test_surfaces_have_joints_and_grain_of_all_kinds_and_stay_in_range():
    drawn = [surfaces.surface(48, np.random.default_rng(seed)) for seed in range(40)]
    assert all(each.shape == (48, 48, 3) and 0 <= each.min() and each.max() <= 1 for each in drawn)
    # Neighbouring pixels' part of the contrast: from stone, rough, to cloth stretched along a direction, smooth.
    rough = [np.abs(np.diff(each, axis=0)).mean() / each.std() for each in drawn]
    assert min(rough) < 0.1 and max(rough) > 0.4
    assert np.array_equal(drawn[3], surfaces.surface(48, np.random.default_rng(3)))


def test_an_object_before_a_surface_hides_it_and_stays_in_its_own_light():
    crops = np.zeros((2, 32, 32, 4), np.uint8)
    crops[:, 8:24, 8:24] = (255, 0, 0, 255)
    for seed in range(5):
        photos = surfaces.shoot(crops, np.random.default_rng(seed))
        inside = photos[:, 14:18, 14:18]
        assert inside[..., 0].mean() > inside[..., 1:].mean() + 0.3 and photos[:, 0].std() > 0
