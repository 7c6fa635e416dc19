"""What a run's folder keeps: its settings and the weights of its network."""

from pathlib import Path

import torch

from . import encoder_weights
from .files import whole
from .model import PRVNet

BEST, LAST = "best.pt", "last.pt"


def solved(config: dict) -> bool:
    """A ridge on an encoder that stays as it is; everything else is trained in epochs."""
    return config["head"] == "ridge" and config["freeze"]


def tuned(config: dict) -> bool:
    """A whole network trained on from a ridge on its encoder as it started."""
    return config["head"] == "ridge" and not config["freeze"]


def fitted(config: dict, train, validation) -> list:
    """The rows that a network's weights come from. What is solved has no epoch to choose: once its error on the validation
    rows is known it is fitted to them too."""
    return train + validation if solved(config) else train


def trained(network, config: dict):
    """The part of a network that its run changes, and keeps: a frozen encoder stays what it started from."""
    return network.heads if config["freeze"] else network


def start(config: dict, run: Path) -> PRVNet:
    """The network of `config` before its first step, with the run's own encoder.pt where it has one."""
    network = PRVNet(config)
    if config.get("encoder_weights"):
        encoder_weights.load(network.encoder, config, run)
    return network


def save(state, path: Path):
    with whole(path) as partial:
        torch.save(state, partial)


def finished(run: Path, config: dict) -> bool:
    """Whether its last epoch is over; what is solved has none."""
    if solved(config):
        return (run / BEST).is_file()
    return (run / LAST).is_file() and torch.load(run / LAST, map_location="cpu", weights_only=True)["epoch"] >= config["epochs"]


def load_best(run: Path, device="cpu") -> PRVNet:
    """The network of a run's best.pt, ready to be used."""
    state = torch.load(run / BEST, map_location=device, weights_only=True)
    config = state["config"]
    network = start(config, run) if config["freeze"] else PRVNet(config, pretrained=False)
    trained(network, config).load_state_dict(state["weights"])
    return network.to(device).eval()
