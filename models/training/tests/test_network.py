"""What needs PyTorch: the network, and the way from labels to a model file."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

sys.path.insert(0, str(Path(__file__).parent))
import synthetic
from prvnet import card, epochs, export, model, novelty, refit_novelty, train
from prvnet.onnx_model import OnnxModel


@pytest.fixture(scope="module")
def network():
    torch.manual_seed(0)
    return model.PRVNet(synthetic.CONFIG).eval()


def test_mean_and_variance_are_numpys():
    features = torch.rand(4, 3, 7)
    expected = np.concatenate([features.numpy().mean(1), features.numpy().var(1, ddof=1)], 1)
    assert np.allclose(model.mean_and_variance(features).numpy(), expected, atol=1e-6)


def test_the_order_of_images_does_not_matter(network):
    images = torch.rand(1, 4, 3, 64, 64)
    assert torch.allclose(network(images), network(images[:, [2, 0, 3, 1]]), atol=1e-4)


def test_a_single_image_is_fed_twice(network):
    image = torch.rand(1, 1, 3, 64, 64)
    assert torch.allclose(network(image), network(torch.cat([image, image], 1)), atol=1e-5)


@pytest.mark.parametrize("head", ["small", "paper"])
@pytest.mark.parametrize("encoder", ["efficientnet_lite0", "convnextv2_atto"])
def test_training_starts_at_the_given_count_within_the_range(encoder, head):
    network = model.PRVNet({**synthetic.CONFIG, "encoder": encoder, "head": head}).eval()
    network.start_at(30.0)
    assert abs(float(network(torch.rand(1, 3, 3, 64, 64)).detach().mean()) - 30) < 10


def test_features_of_a_frozen_encoder_give_the_images_answer(network):
    images = torch.rand(2, 3, 3, 64, 64)
    assert torch.allclose(network(images), network(network.encode(images)), atol=1e-4)


@pytest.mark.parametrize("freeze, head", [(True, "ridge"), (True, "small"), (False, "small"), (False, "ridge")])
def test_labels_become_a_model_file(tmp_path, monkeypatch, freeze, head):
    synthetic.make(tmp_path, objects=40, size=64)
    options = ["--labels", tmp_path / "labels.csv", "--inputs", tmp_path / "inputs", "--out", tmp_path / "run",
               "--size", 64, "--encoder", "convnextv2_atto" if (freeze, head) == (False, "small") else "efficientnet_lite0",
               "--freeze" if freeze else "--no-freeze", "--head", head,
               "--epochs", 3, "--variants", 2, "--heads", 1 if head == "ridge" else 2, "--device", "cpu"]  # fmt: skip
    train.train(train.arguments(list(map(str, options))))
    log = tmp_path / "run" / "log.csv"
    assert log.read_text().count("\n") == 4 if head == "small" or not freeze else not log.exists()

    # The same command again finds the run finished.
    def fail(*_):
        raise AssertionError("it ran again")

    with monkeypatch.context() as patch:
        patch.setattr(epochs.Descent, "epoch", fail)
        patch.setattr(train.ridge, "fit", fail)
        train.train(train.arguments(list(map(str, options))))
    with pytest.raises(SystemExit, match="other settings"):
        train.train(train.arguments(list(map(str, [*options, "--seed", 16]))))

    file = tmp_path / "prvnet.onnx"
    export.main(["--run", str(tmp_path / "run"), "--out", str(file), "--turns", "2"])
    onnx_model = OnnxModel(file)
    config = json.loads((tmp_path / "run" / "config.json").read_text())
    known = len(config["rows"]["train"]) + (len(config["rows"]["validation"]) if freeze and head == "ridge" else 0)
    assert onnx_model.metadata["prv.trained_on"] == str(known) and onnx_model.metadata["prv.turn"] == "0"
    assert config["range"][0] <= onnx_model.predict(np.random.rand(3, 3, 64, 64)) <= config["range"][1]

    answer, novelty = onnx_model.answer(np.random.rand(3, 3, 64, 64))
    low, high = onnx_model.interval(answer)
    assert low <= round(answer) <= high and novelty >= 0
    # The second export takes the errors that the first has measured.
    residuals = (tmp_path / "run" / "residuals.csv").read_text()
    assert residuals.count("\n") == 1 + len(config["rows"]["train"]) + len(config["rows"]["validation"])
    path = tmp_path / "CARD.md"
    path.write_text("# Card\n\nby hand\n")
    for _ in range(2):
        card.main(["--run", str(tmp_path / "run"), "--model", str(file), "--card", str(path)])
    assert path.read_text().count("best constant") == 1 and "% interval reaches" in path.read_text() and "by hand" in path.read_text()
    assert "| all | " in path.read_text() and "light, camera and placement alone" in path.read_text()


def test_a_run_that_keeps_the_mean_of_its_weights_may_be_stopped(tmp_path, monkeypatch):
    synthetic.make(tmp_path, objects=40, size=64)
    options = ["--labels", tmp_path / "labels.csv", "--inputs", tmp_path / "inputs", "--size", 64, "--no-freeze", "--head", "ridge",
               "--encoder", "efficientnet_lite0", "--epochs", 3, "--variants", 2, "--encoder-lr", 1e-2, "--device", "cpu"]  # fmt: skip

    def run(name, averaging):
        train.train(train.arguments(list(map(str, [*options, "--averaging", averaging, "--out", tmp_path / name]))))
        return torch.load(tmp_path / name / "last.pt", weights_only=True)

    epoch = epochs.Descent.epoch
    with monkeypatch.context() as patch:
        patch.setattr(epochs.Descent, "epoch", lambda self, *args: 1 / 0 if args[2] == 1 else epoch(self, *args))
        with pytest.raises(ZeroDivisionError):
            run("stopped", 0.5)
    stopped, whole, plain = run("stopped", 0.5), run("whole", 0.5), run("plain", 0)
    name = "heads.0.weight"
    for kept in ("mean", "weights"):
        assert torch.equal(stopped[kept][name], whole[kept][name]), kept
    # The mean follows the descent and does not lead it.
    assert torch.equal(whole["weights"][name], plain["weights"][name])
    assert not torch.equal(whole["mean"][name], plain["weights"][name]) and "mean" not in plain


def test_the_turns_give_each_other_intervals(tmp_path, monkeypatch):
    synthetic.make(tmp_path, objects=60, size=64)
    runs = [tmp_path / f"turn-{turn}" for turn in range(5)]
    for turn, run in enumerate(runs):
        options = ["--labels", tmp_path / "labels.csv", "--inputs", tmp_path / "inputs", "--out", run, "--turn", turn,
                   "--size", 64, "--encoder", "efficientnet_lite0", "--variants", 2, "--device", "cpu"]  # fmt: skip
        train.train(train.arguments(list(map(str, options))))

    def exported(sisters):
        export.main(["--run", str(runs[0]), "--out", str(tmp_path / "m.onnx"), "--sisters", *map(str, sisters)])

    exported(runs[1:])
    known = json.loads((runs[0] / "config.json").read_text())["rows"]
    told = [line.split(",")[0] for run in runs[1:] for line in (run / "held_out.csv").read_text().splitlines()[1:]]
    assert sorted(told) == sorted(known["train"] + known["validation"])
    metadata = OnnxModel(tmp_path / "m.onnx").metadata
    assert float(metadata["prv.interval_low"]) < 0 < float(metadata["prv.interval_high"])
    path = tmp_path / "CARD.md"
    card.main(["--run", str(runs[0]), "--model", str(tmp_path / "m.onnx"), "--sisters", *map(str, runs), "--card", str(path)])
    # 54 rows of 60 are `ok`, one of them without a label.
    assert "Every object held out once, by 5 networks of this recipe, 53 labels" in path.read_text()
    with pytest.raises(SystemExit, match="by none of the other runs"):
        exported(runs[1:4])
    # What the run itself holds out stays out of it.
    exported(runs)
    before = OnnxModel(tmp_path / "m.onnx")
    assert before.metadata["prv.interval_low"] == metadata["prv.interval_low"]

    # What the file itself gives is fitted as what PyTorch gives.
    monkeypatch.setattr(novelty, "COMPONENTS", 10)
    files = ["--model", tmp_path / "m.onnx", "--labels", tmp_path / "labels.csv", "--inputs", tmp_path / "inputs"]
    refit_novelty.main([*map(str, files), "--statuses", "ok"])
    after, photos = OnnxModel(tmp_path / "m.onnx"), np.random.default_rng(0).random((3, 3, 64, 64))
    assert after.predict(photos) == before.predict(photos) and after.answer(photos)[1] != before.answer(photos)[1]
    assert after.metadata == before.metadata
    exported(runs)
    assert after.answer(photos)[1] == pytest.approx(OnnxModel(tmp_path / "m.onnx").answer(photos)[1], rel=1e-2)
