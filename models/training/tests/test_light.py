"""What needs NumPy and Pillow only."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
import synthetic
from prvnet import augment, baseline, labels, metrics, repeatability, splits


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data")
    synthetic.make(folder, objects=60, size=48)
    return folder


def test_rows_without_a_label_or_with_another_status_are_left_out(data):
    rows = labels.read(data / "labels.csv", data / "inputs")
    assert len(rows) == 60 - 6 - 1
    assert len(labels.read(data / "labels.csv", data / "inputs", ("ok", "not_converged"))) == 59


def test_a_row_whose_size_is_another_one_has_no_crops(data, tmp_path):
    text = (data / "labels.csv").read_text().splitlines()
    cells = text[5].split(",")
    cells[4] = "0.11111"
    (tmp_path / "labels.csv").write_text("\n".join([*text[:5], ",".join(cells), *text[6:]]))
    rows = labels.read(tmp_path / "labels.csv", data / "inputs")
    assert cells[0] not in {row.object for row in rows} and len(rows) == 52


def test_only_the_first_sizes_are_read_where_that_is_asked(data, tmp_path):
    header, *lines = (data / "labels.csv").read_text().splitlines()
    # Every other row becomes its object's second size.
    assert header.endswith(",draw")
    marked = [f"{line.rpartition(',')[0]},{k % 2}" for k, line in enumerate(lines)]
    (tmp_path / "labels.csv").write_text("\n".join([header, *marked]))

    def count(**asked):
        return len(labels.read(tmp_path / "labels.csv", data / "inputs", ("ok", "not_converged"), **asked))

    assert count() == count(sizes=2) == 59
    assert count(sizes=1) in (29, 30)


def test_sizes_and_variants_of_an_object_share_a_fold():
    assert splits.group_of("a/b.sh3f/mug#red@0.09") == "a/b.sh3f/mug"
    assert splits.fold_of(splits.group_of("mug#1")) == splits.fold_of("mug")


@pytest.mark.parametrize("original", ["made:mug/17", "Scopia/scopia/clothes_washing_machine/clothes_washing_machine"])
def test_textures_of_an_object_never_part_it(original):
    keys = [original, *(f"{original}~texture={number}" for number in range(20))]
    assert {splits.group_of(key) for key in keys} == {original}
    assert len({splits.fold_of(splits.group_of(key)) for key in keys}) == 1


def test_made_objects_of_one_family_are_different_objects():
    groups = {splits.group_of(f"made:mug/{seed}~texture=1") for seed in range(40)}
    assert len(groups) == 40 and len({splits.fold_of(group) for group in groups}) > 5


def test_folds_are_the_same_on_every_machine():
    assert [splits.fold_of(name) for name in ("mug", "chair", "lamp")] == [2, 7, 1]


def test_five_turns_hold_every_object_out_once():
    rows = [SimpleNamespace(group=name) for name in ("mug", "chair", "lamp")]
    held_out = [[row.group for row in splits.split(rows, turn)[2]] for turn in range(splits.TURNS)]
    assert held_out == [["lamp"], ["mug"], [], ["chair"], []]


def test_every_row_is_held_out_exactly_once_in_five_turns(data):
    rows = labels.read(data / "labels.csv", data / "inputs")
    held_out = [row.id for turn in range(5) for row in splits.split(rows, turn)[2]]
    assert sorted(held_out) == [row.id for row in rows]
    for turn in range(5):
        parts = splits.split(rows, turn)
        assert sum(len(part) for part in parts) == len(rows)
        assert not {r.group for r in parts[0]} & {r.group for r in parts[2]}


def test_a_shoot_is_reproducible_and_stays_in_range(data):
    rows = labels.read(data / "labels.csv", data / "inputs")
    crops = labels.crops(data / "inputs", rows[0])
    for seed in range(30):
        first = augment.shoot(crops, np.random.default_rng(seed))
        assert np.array_equal(first, augment.shoot(crops, np.random.default_rng(seed)))
        assert first.shape == (5, 48, 48, 3) and first.dtype == np.float32
        assert first.min() >= 0 and first.max() <= 1


def test_half_of_the_shoots_are_on_white():
    kinds = [augment.Scene(np.random.default_rng(seed)).kind for seed in range(400)]
    assert 150 < kinds.count("white") < 250
    assert set(kinds) == {"white", "solid", "gradient", "noise", "table"}


def test_transparent_pixels_are_white_whatever_their_colour():
    crop = np.zeros((4, 4, 4), np.uint8)
    crop[0, 0] = (10, 20, 30, 255)
    image = augment.on_white(crop)
    assert np.allclose(image[1:], 1) and np.allclose(image[0, 0] * 255, [10, 20, 30])


def test_the_interval_contains_the_mean_and_shrinks_with_more_objects():
    rng = np.random.default_rng(0)
    few, many = rng.exponential(5, 20), rng.exponential(5, 500)
    (a, b), (c, d) = metrics.bootstrap(few, range(20)), metrics.bootstrap(many, range(500))
    assert a < few.mean() < b and c < many.mean() < d and d - c < b - a


def test_image_statistics_see_the_detail_that_the_labels_come_from(data):
    rows = labels.read(data / "labels.csv", data / "inputs")
    errors, constant = [], []
    for turn in range(5):
        known = [row.views for part in splits.split(rows, turn)[:2] for row in part]
        truth = np.array([row.views for row in splits.split(rows, turn)[2]])
        errors.extend(np.abs(baseline.evaluate(data / "inputs", rows, turn) - truth))
        constant.extend(np.abs(np.median(known) - truth))
    assert np.mean(errors) < 0.5 * np.mean(constant)


def test_two_measurements_are_compared_where_both_files_have_the_object(data, tmp_path):
    lines = (data / "labels.csv").read_text().splitlines()
    columns = lines[0].split(",")
    again = [lines[0]]
    for line in lines[1:31]:
        cells = dict(zip(columns, line.split(",")))
        if cells["v_gain"]:
            cells["v_gain"] = str(int(cells["v_gain"]) + 2)
        again.append(",".join(cells[column] for column in columns))
    (tmp_path / "again.csv").write_text("\n".join(again))
    both = repeatability.pairs(data / "labels.csv", tmp_path / "again.csv", "v_gain")
    assert len(both) == 29 and set(both[:, 1] - both[:, 0]) == {2.0}
    table = repeatability.lines(data / "labels.csv", tmp_path / "again.csv")
    assert "| 29 | 2.00 views |" in table[2] and "| 0.00 views |" in table[3]


def test_the_target_chooses_the_column(data):
    gain, near, star = (labels.read(data / "labels.csv", data / "inputs", target=target) for target in labels.TARGETS)
    assert [row.views - 8 for row in gain] == [row.views for row in near]
    assert [row.views + 9 for row in gain] == [row.views for row in star]
