"""encoder.pt: a pre-trained encoder's weights, with the objects that they have seen."""

from pathlib import Path

import torch

from . import encoders

FILE = "encoder.pt"


def read(path: Path) -> dict:
    """`encoder` (name), `weights`, `groups` (objects seen), `fingerprint` (of the weights) of `prvnet.pretrain`'s file."""
    if not path.is_file():
        raise SystemExit(f"{path} is not there; `python -m prvnet.pretrain` writes it when it has finished")
    state = torch.load(path, map_location="cpu", weights_only=True)
    if not (isinstance(state, dict) and {"encoder", "weights", "groups"} <= state.keys()):
        raise SystemExit(f"{path} is not an encoder.pt of prvnet.pretrain")
    return {**state, "fingerprint": encoders.fingerprint(state["weights"])}


def refuse_leaks(state: dict, encoder: str, held_out):
    """Weights of another encoder, or that have seen an object of the rows `held_out`, would make the run worthless."""
    if state["encoder"] != encoder:
        raise SystemExit(f"the weights are those of {state['encoder']}, not of {encoder}")
    seen = sorted({row.group for row in held_out} & set(state["groups"]))
    if seen:
        raise SystemExit(f"the weights have seen {len(seen)} objects that this run chooses by or holds out, {seen[0]} "
                         "for one: pre-train with the same --turn")  # fmt: skip


def load(encoder: encoders.Encoder, config: dict, run: Path):
    """Puts the run's weights into `encoder`."""
    state = read(run / FILE)
    if state["fingerprint"] != config["encoder_weights"]:
        raise SystemExit(f"{run / FILE} is not the file that the run started from")
    encoder.net.load_state_dict(state["weights"])
