"""Trains PRVNet; may be stopped and started again with the same command.

    python -m prvnet.train --labels models/labels.csv --inputs DIR --encoder efficientnet_lite0 --out runs/x

The folder gets config.json, where.json, best.pt (least validation L1, or the ridge), and encoder.pt where the encoder
starts from `prvnet.pretrain`'s weights; log.csv and last.pt (to resume) where there are epochs.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np
import torch

from . import PAPER_RANGE, encoder_weights, encoders, labels, metrics, ridge
from .epochs import by_epochs, evaluate
from .model import HEADS
from .runs import BEST, LAST, fitted, save, solved, start, trained, tuned
from .sources import Bank, Photos
from .splits import TURNS, split

# `--paper`: the paper's network, but for ImageNet weights, which no package index has.
PAPER = {"encoder": "convnextv2_tiny", "freeze": False, "head": "paper", "heads": 1, "levels": "last", "images": "3",
         "range": "paper", "target": "v_star"}  # fmt: skip


def arguments(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--labels", type=Path, required=True, help="labels.csv of `prv label`")
    add("--inputs", type=Path, required=True, help="folder of `prv inputs`")
    add("--out", type=Path, required=True, help="folder of this run")
    add("--paper", action="store_true", help="the paper's network and label; other options still count")
    add("--encoder", choices=encoders.NAMES, default="efficientnet_lite0")
    add("--encoder-weights", type=Path, help="encoder.pt of `prvnet.pretrain` to start from")
    add("--levels", choices=("last", "all"), default="all", help="pool the encoder's output or every stage's")
    add("--head", choices=tuple(HEADS), help="default: ridge on a frozen encoder, else small; a ridge is solved, "
        "and with --no-freeze the whole network is tuned from there")  # fmt: skip
    add("--heads", type=int, help="heads trained side by side and averaged (default 5; a ridge has one)")
    add("--size", type=int, help="side of the input images, pixels (default: what the encoder was made for)")
    add("--images", choices=("1-5", "3"), default="1-5", help="initial images of a training sample")
    add("--range", choices=("labels", "paper"), default="labels", help="the range of answers")
    add("--target", choices=labels.TARGETS, default="v_gain", help="which label to learn")
    add("--statuses", default="ok", help="label statuses to train on, by commas")
    add("--sizes", type=int, help="learn from the first of each object's sizes alone (default: from all)")
    add("--freeze", action=argparse.BooleanOptionalAction, default=None,
        help="leave the encoder as it is (default for encoders with ImageNet weights)")  # fmt: skip
    add("--variants", type=int, default=16, help="random shoots of each object with a frozen encoder")
    add("--turned", type=Path, nargs="+", default=[],
        help="folders of `prv inputs --yaw-deg` of the same labels, to tune by as well")  # fmt: skip
    add("--bank", type=Path, help="folder for the frozen encoder's features (default: beside the inputs)")
    add("--epochs", type=int, help="passes over the objects (default 150 frozen, 60 otherwise)")
    add("--batch", type=int, default=64)
    add("--lr", type=float, help="learning rate of the heads at the given batch (default 5e-4 frozen, else 10 x the encoder's, of a ridge 0.1 x)")
    add("--encoder-lr", type=float, default=1.5e-4, help="of the encoder, times batch / 256")
    add("--weight-decay", type=float, default=0.05)
    add("--averaging", type=float, default=0.0,
        help="keep the running mean of the weights, of which each step leaves so much; 0: the weights themselves")  # fmt: skip
    add("--loss", choices=("l1", "huber"), default="l1")
    add("--weight-by-sigma", action="store_true", help="count uncertain labels less")
    add("--turn", type=int, choices=range(TURNS), default=0, help="which folds are held out")
    add("--seed", type=int, default=0)
    add("--threads", type=int, default=2)
    add("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    args = parser.parse_args(argv)
    if args.paper:
        parser.set_defaults(**PAPER)
        args = parser.parse_args(argv)
    has_weights = args.encoder in encoders.EFFICIENTNET_LITE
    if args.freeze is None:
        args.freeze = has_weights
    args.head = args.head or ("ridge" if args.freeze else "small")
    if (args.freeze or args.head == "ridge") and not has_weights and args.encoder_weights is None:
        option = "--freeze" if args.freeze else "--head ridge"
        parser.error(f"{option}: {args.encoder} has no ImageNet weights; give --encoder-weights of prvnet.pretrain")
    if args.head == "ridge" and args.heads not in (None, 1):
        parser.error("--heads: a ridge has one")
    if not 0 <= args.averaging < 1:
        parser.error("--averaging: must be at least 0 and less than 1")
    if args.freeze and args.turned:
        parser.error("--turned: a frozen encoder's features are of the crops themselves; give --no-freeze")
    if solved(vars(args)) and (args.loss != "l1" or args.weight_by_sigma):
        parser.error("--loss, --weight-by-sigma: a ridge is solved, not trained; give --head small")
    args.heads = args.heads or (1 if args.head == "ridge" else 5)
    args.size = args.size or encoders.native_size(args.encoder)
    args.epochs = args.epochs or (150 if args.freeze else 60)
    args.bank = args.bank or args.inputs / ".features"
    if args.lr is None:
        times = 0.1 if args.head == "ridge" else 10
        args.lr = 5e-4 if args.freeze else times * args.encoder_lr * args.batch / 256
    return args


def configuration(args, train, validation, test, weights: dict | None) -> dict:
    """Everything that fixes the run's result; `weights` is what `encoder_weights.read` gives."""
    chosen = ("encoder", "levels", "head", "heads", "size", "images", "freeze", "variants", "turn", "seed", "statuses", "target")
    of_epochs = ("epochs", "batch", "lr", "encoder_lr", "weight_decay", "averaging", "loss", "weight_by_sigma")
    settings = {key: getattr(args, key) for key in chosen + (() if solved(vars(args)) else of_epochs)}
    views = [row.views for row in fitted(settings, train, validation)]
    low, high = PAPER_RANGE if args.range == "paper" else (int(min(views)), int(max(views)))
    if args.sizes is not None:
        settings["sizes"] = args.sizes
    if args.turned:
        settings["turned"] = len(args.turned)
    return {
        **settings,
        "encoder_weights": weights and weights["fingerprint"],
        "range": [low, max(high, low + 1)],
        "trained_on": len(views),
        "rows": {"train": ids(train), "validation": ids(validation), "test": ids(test)},
    }


def ids(rows):
    return [row.id for row in rows]


def train(args) -> dict:
    torch.set_num_threads(args.threads)
    torch.manual_seed(args.seed)
    rows = labels.read(args.labels, args.inputs, args.statuses.split(","), args.target, args.sizes)
    parts = split(rows, args.turn)
    train_rows, validation_rows, test_rows = parts
    if len(train_rows) < 2 or not validation_rows:
        raise SystemExit(f"{len(rows)} rows are too few to split into training and validation")
    weights = encoder_weights.read(args.encoder_weights) if args.encoder_weights else None
    if weights:
        encoder_weights.refuse_leaks(weights, args.encoder, validation_rows + test_rows)
    config = configuration(args, *parts, weights)
    args.out.mkdir(parents=True, exist_ok=True)
    known = args.out / "config.json"
    if known.is_file() and json.loads(known.read_text()) != config:
        raise SystemExit(f"{args.out} holds a run with other settings or labels; give another --out")
    known.write_text(json.dumps(config, indent=1))
    # Beside the settings, since files may move without changing the run.
    where = {"labels": str(args.labels.resolve()), "inputs": str(args.inputs.resolve()), "bank": str(args.bank.resolve()),
             "turned": [str(folder.resolve()) for folder in args.turned]}  # fmt: skip
    (args.out / "where.json").write_text(json.dumps(where))
    if weights:
        save(weights, args.out / encoder_weights.FILE)

    side = labels.crops(args.inputs, train_rows[0]).shape[1]
    if side < args.size:
        print(f"the crops in {args.inputs} have {side} pixels a side, fewer than the network's {args.size}: "
              f"`prv inputs --size {args.size}` makes finer ones")  # fmt: skip
    device = torch.device(args.device)
    network = start(config, args.out).to(device)
    median = float(np.median([row.views for row in train_rows]))
    known_rows = train_rows + validation_rows
    # Who goes on has his heads in last.pt.
    solves = tuned(config) and not (args.out / LAST).is_file()
    bank = None
    if args.freeze or solves:
        bank = Bank(args.bank, args.inputs, known_rows, network, args.variants, device)
    if args.freeze:
        network.encoder.requires_grad_(False)
        source = bank
        torch.set_num_threads(1)  # the heads' matrices are too small to share
    else:
        source = Photos(args.inputs, known_rows, args.size, args.turned)
    constant = metrics.l1(median, [row.views for row in validation_rows])
    print(f"{len(train_rows)} rows to train on, {len(validation_rows)} to choose by, {len(test_rows)} held out; "
          f"labels {config['range']}, validation L1 of the training median {constant:.2f}")  # fmt: skip
    if solved(config):
        solve(network, source, train_rows, validation_rows, args, config, device)
        return config
    if solves:
        ridge.fit(network, bank, train_rows, config)
    elif not tuned(config):
        network.start_at(median)
    by_epochs(network, source, train_rows, validation_rows, args, config, device)
    return config


def solve(network, source, train_rows, validation_rows, args, config, device):
    """A ridge's weights, fitted twice: for its error on the validation rows, and for good."""
    if (args.out / BEST).is_file():
        return
    begin = time.process_time()
    ridge.fit(network, source, train_rows, config)
    validation = evaluate(network, source, validation_rows, device)
    ridge.fit(network, source, fitted(config, train_rows, validation_rows), config)
    print(f"solved in {time.process_time() - begin:.0f} CPU seconds, validation L1 {validation:.2f}")
    save({"weights": trained(network, config).state_dict(), "config": config, "epoch": 1, "validation_l1": validation}, args.out / BEST)


if __name__ == "__main__":
    train(arguments())
