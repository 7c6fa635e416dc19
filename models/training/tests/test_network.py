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
from prvnet import card, export, model, train
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


@pytest.mark.parametrize("freeze, head", [(True, "ridge"), (True, "small"), (False, "small")])
def test_labels_become_a_model_file(tmp_path, monkeypatch, freeze, head):
    synthetic.make(tmp_path, objects=40, size=64)
    options = ["--labels", tmp_path / "labels.csv", "--inputs", tmp_path / "inputs", "--out", tmp_path / "run",
               "--size", 64, "--encoder", "efficientnet_lite0" if freeze else "convnextv2_atto", "--head", head,
               "--epochs", 3, "--variants", 2, "--heads", 1 if head == "ridge" else 2, "--device", "cpu"]  # fmt: skip
    train.train(train.arguments(list(map(str, options))))
    log = tmp_path / "run" / "log.csv"
    assert head == "ridge" or log.read_text().count("\n") == 4

    # The same command again finds the run finished.
    def fail(*_):
        raise AssertionError("it ran again")

    with monkeypatch.context() as patch:
        patch.setattr(train, "epoch_of", fail)
        patch.setattr(train.ridge, "fit", fail)
        train.train(train.arguments(list(map(str, options))))
    with pytest.raises(SystemExit, match="other settings"):
        train.train(train.arguments(list(map(str, [*options, "--seed", 16]))))

    file = tmp_path / "prvnet.onnx"
    export.main(["--run", str(tmp_path / "run"), "--out", str(file), "--turns", "2"])
    onnx_model = OnnxModel(file)
    config = json.loads((tmp_path / "run" / "config.json").read_text())
    known = len(config["rows"]["train"]) + (len(config["rows"]["validation"]) if head == "ridge" else 0)
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
