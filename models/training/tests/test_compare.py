"""A list of recipes becomes a table, once."""

import csv
import json
import shutil
import sys
from pathlib import Path

import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

sys.path.insert(0, str(Path(__file__).parent))
import synthetic
from prvnet import compare, labels

RECIPES = {
    "defaults": {"size": 64, "epochs": 2, "variants": 6, "heads": 1, "threads": 1},
    "pretraining": {"short": {"size": 64, "epochs": 1, "decoder-width": 16, "threads": 1}},
    "recipes": [
        {"name": "constant", "kind": "constant"},
        {"name": "image statistics", "kind": "statistics"},
        {"name": "atto frozen", "pretraining": "short", "options": {"encoder": "convnextv2_atto", "freeze": True}},
        {"name": "paper", "slow": True, "options": {"paper": True}},
    ],
}


@pytest.fixture(scope="module")
def compared(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data")
    synthetic.make(folder, objects=40, size=64)
    (folder / "recipes.json").write_text(json.dumps(RECIPES))
    words = ["--labels", folder / "labels.csv", "--inputs", folder / "inputs", "--out", folder / "out",
             "--recipes", folder / "recipes.json", "--latency-ms", 10000]  # fmt: skip
    words = list(map(str, words))
    compare.main([*words, "--seeds", "2"])
    return folder, words


def table(folder):
    with open(folder / "out" / "compare.csv", newline="") as file:
        return {line["recipe"]: line for line in csv.DictReader(file)}


def test_every_recipe_but_the_slow_ones_gets_its_line(compared):
    folder, _ = compared
    lines = table(folder)
    assert list(lines) == ["constant", "image statistics", "atto frozen"]
    # Synthetic labels follow image statistics, so these must be easy to beat the constant with.
    assert float(lines["image statistics"]["held_out_l1"]) < float(lines["constant"]["held_out_l1"])
    assert lines["constant"]["validation_l1"] == lines["atto frozen"]["validation_constant_l1"]
    line = lines["atto frozen"]
    assert float(line["held_out_low"]) <= float(line["held_out_l1"]) <= float(line["held_out_high"])
    assert int(line["parameters"]) > 3e6 and float(line["latency_1_thread_ms"]) > 0 and float(line["train_cpu_s"]) > 0
    text = (folder / "out" / "compare.md").read_text()
    assert text.count("\n| ") == 4 and text.count("**") == 2


def test_what_is_finished_is_not_run_again_and_other_recipes_join(compared, monkeypatch):
    folder, words = compared
    before = table(folder)

    def fail(*_):
        raise AssertionError("it ran again")

    for name in ("train", "of_network", "of_simple_recipe"):
        monkeypatch.setattr(compare, name, fail)
    compare.main([*words, "--seeds", "2"])
    assert table(folder) == before
    with pytest.raises(AssertionError, match="ran again"):
        compare.main([*words, "--seeds", "2", "--only", "paper"])


def test_crops_of_the_very_size_are_taken_if_they_are_of_the_same_rows(compared, tmp_path):
    folder, words = compared
    args = compare.arguments(words)
    rows = labels.read(args.labels, args.inputs)
    assert compare.inputs_of(args, rows, 48) == args.inputs
    synthetic.make(tmp_path, objects=40, size=48)
    (tmp_path / "inputs").rename(folder / "inputs-48")
    with pytest.raises(SystemExit, match="inputs-48"):
        compare.inputs_of(args, rows, 48)
    shutil.copy(args.inputs / "index.csv", folder / "inputs-48" / "index.csv")
    assert compare.inputs_of(args, rows, 48) == folder / "inputs-48"


def test_five_turns_hold_every_object_out_once(compared):
    folder, words = compared
    out = folder / "turns"
    compare.main([*words, "--turns", "5", "--only", "constant,image statistics", "--out", str(out)])
    with open(out / "compare.csv", newline="") as file:
        assert {line["held_out_rows"] for line in csv.DictReader(file)} == {"35"}


def test_the_choice_is_the_best_network_in_time():
    results = {
        "constant": {"validation_l1": 1.0},
        "slow": {"validation_l1": 2.0, "latency_2_threads_ms": 50.0, "cpu_1_thread_ms": 60.0},
        "good": {"validation_l1": 3.0, "latency_2_threads_ms": 90.0, "cpu_1_thread_ms": 39.0},
        "quick": {"validation_l1": 4.0, "latency_2_threads_ms": 3.0, "cpu_1_thread_ms": 5.0},
    }
    assert compare.best_of(results, 40.0) == "good"
    assert compare.best_of(results, 1.0) is None and compare.best_of(results, 100.0) == "slow"
