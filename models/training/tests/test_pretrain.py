"""Pre-training on crops, and networks that start from it."""

import json
import sys
from pathlib import Path

import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

sys.path.insert(0, str(Path(__file__).parent))
import synthetic
from prvnet import encoder_weights, encoders, labels, masked, pretrain, runs, splits, train


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data")
    synthetic.make(folder, objects=40, size=64)
    return folder


def options(data, out, epochs=1):
    words = ["--inputs", data / "inputs", "--out", out, "--size", 64, "--epochs", epochs, "--decoder-width", 16,
             "--device", "cpu", "--threads", 1]  # fmt: skip
    return pretrain.arguments(list(map(str, words)))


@pytest.fixture(scope="module")
def weights(data, tmp_path_factory):
    return pretrain.pretrain(options(data, tmp_path_factory.mktemp("pretrain")))


def test_no_feature_of_a_visible_patch_depends_on_a_hidden_one():
    torch.manual_seed(0)
    encoder = encoders.make("convnextv2_atto", 128)
    for parameter in encoder.parameters():
        if parameter.ndim < 2:
            # Biases and the response normalisation start at zero, where nothing could leak.
            torch.nn.init.normal_(parameter, std=0.3)
    sparse = masked.SparseEncoder(encoder.net).eval()
    images, mask = torch.rand(2, 3, 128, 128), masked.random_mask(2, 128, 0.6)
    hidden = mask.repeat_interleave(32, 2).repeat_interleave(32, 3)
    with torch.no_grad():
        features, others = (sparse(each, mask) for each in (images, images * (1 - hidden) + torch.rand(2, 3, 128, 128) * hidden))
        assert torch.equal(features, others) and features.abs().max() > 0.1 and not (features * mask).any()
        # Without a mask the very same network sees everything.
        assert torch.equal(encoder.net.stages(encoder.net.stem(images)), encoder.net.forward_features(images))


def test_six_patches_of_ten_are_hidden_others_each_time():
    mask = masked.random_mask(50, 160, 0.6)
    assert mask.shape == (50, 1, 5, 5) and set(mask.sum((1, 2, 3)).tolist()) == {15.0}
    assert (mask.mean(0) > 0.3).all() and (mask.mean(0) < 0.9).all()


def test_a_patch_is_judged_less_its_own_mean_and_an_empty_one_not_at_all():
    images = torch.rand(1, 3, 64, 64)
    images[..., :32, :32] = 0.9 + 0.001 * torch.rand(3, 32, 32)
    target = masked.target_of(images)
    assert target[0, :, 0, 0].abs().max() < 0.05
    assert abs(float(target[0, :, 1, 1].mean())) < 1e-5 and abs(float(target[0, :, 1, 1].std()) - 1) < 0.02
    assert torch.equal(torch.nn.functional.pixel_shuffle(masked.patches(images), 32), images)


def test_an_interrupted_run_ends_as_one_that_was_not(data, tmp_path, monkeypatch):
    whole = pretrain.pretrain(options(data, tmp_path / "whole", epochs=2))
    epoch_of = pretrain.epoch_of
    with monkeypatch.context() as patch:
        patch.setattr(pretrain, "epoch_of", lambda *args: 1 / 0 if args[3] == 1 else epoch_of(*args))
        with pytest.raises(ZeroDivisionError):
            pretrain.pretrain(options(data, tmp_path / "again", epochs=2))
    assert not (tmp_path / "again" / "encoder.pt").exists()
    again = pretrain.pretrain(options(data, tmp_path / "again", epochs=2))
    assert encoder_weights.read(whole)["fingerprint"] == encoder_weights.read(again)["fingerprint"]
    assert len((tmp_path / "again" / "log.csv").read_text().splitlines()) == 3


def test_objects_held_out_or_chosen_by_are_not_seen(data, weights):
    rows = labels.photographed(data / "inputs")
    known, validation, test = splits.split(rows)
    assert len(rows) == 40 and validation and test
    assert encoder_weights.read(weights)["groups"] == sorted(row.group for row in known)


def run_options(data, out, weights, *more):
    words = ["--labels", data / "labels.csv", "--inputs", data / "inputs", "--out", out, "--size", 64, "--encoder",
             "convnextv2_atto", "--encoder-weights", weights, "--epochs", 1, "--variants", 2, "--heads", 1, "--device", "cpu",
             "--threads", 1, *more]  # fmt: skip
    return train.arguments(list(map(str, words)))


@pytest.mark.parametrize("freeze", [True, False])
def test_a_run_starts_from_the_weights_and_keeps_them_by_itself(data, weights, tmp_path, freeze):
    run = tmp_path / "run"
    config = train.train(run_options(data, run, weights, "--freeze" if freeze else "--no-freeze", "--encoder-lr", 1e-6))
    pretrained = encoder_weights.read(weights)
    assert config["encoder_weights"] == pretrained["fingerprint"] == json.loads((run / "config.json").read_text())["encoder_weights"]
    # Nothing but the run's folder is needed from here on.
    trained = runs.load_best(run).encoder.net.state_dict()
    apart = max(float((trained[key] - value).abs().max()) for key, value in pretrained["weights"].items())
    assert apart == 0 if freeze else 0 < apart < 1e-3


def test_weights_that_have_seen_the_objects_held_out_are_refused(data, weights, tmp_path):
    with pytest.raises(SystemExit, match="have seen .* --turn"):
        train.train(run_options(data, tmp_path / "run", weights, "--turn", 1))
    with pytest.raises(SystemExit, match="those of convnextv2_atto, not of convnextv2_femto"):
        train.train(run_options(data, tmp_path / "run", weights, "--encoder", "convnextv2_femto"))
    with pytest.raises(SystemExit, match="is not there"):
        train.train(run_options(data, tmp_path / "run", tmp_path / "none.pt"))


def test_a_random_encoder_is_not_frozen(data, capsys):
    with pytest.raises(SystemExit):
        train.arguments(["--labels", "l", "--inputs", "i", "--out", "o", "--encoder", "convnextv2_atto", "--freeze"])
    assert "has no ImageNet weights" in capsys.readouterr().err
