"""Trains PRVNet; may be stopped and started again with the same command.

    python -m prvnet.train --labels models/labels.csv --inputs DIR --encoder efficientnet_lite0 --out runs/x

The folder gets config.json, where.json, best.pt (least validation L1, or the ridge), and encoder.pt where the encoder
starts from `prvnet.pretrain`'s weights; log.csv and last.pt (to resume) where there are epochs.
"""

import argparse
import csv
import json
import math
import time
from pathlib import Path

import numpy as np
import torch
from tqdm import tqdm

from . import INITIAL_IMAGES, MAX_IMAGES, PAPER_RANGE, encoder_weights, encoders, labels, metrics, ridge
from .model import HEADS, PRVNet
from .sources import Bank, Photos
from .splits import TURNS, split

VALIDATION_VARIANTS = 6

# Errors, views, below which the Huber loss is quadratic: about what two labels of one object differ by.
HUBER_DELTA = 2.0

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
    add("--head", choices=tuple(HEADS), help="default: ridge on a frozen encoder, else small")
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
    add("--bank", type=Path, help="folder for the frozen encoder's features (default: beside the inputs)")
    add("--epochs", type=int, help="passes over the objects (default 150 frozen, 60 otherwise)")
    add("--batch", type=int, default=64)
    add("--lr", type=float, help="learning rate of the heads at the given batch (default 5e-4 frozen, else 10 x encoder)")
    add("--encoder-lr", type=float, default=1.5e-4, help="of the encoder, times batch / 256")
    add("--weight-decay", type=float, default=0.05)
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
    if args.freeze and not has_weights and args.encoder_weights is None:
        parser.error(f"--freeze: {args.encoder} has no ImageNet weights; give --encoder-weights of prvnet.pretrain")
    args.head = args.head or ("ridge" if args.freeze else "small")
    if args.head == "ridge" and not args.freeze:
        parser.error("--head ridge: it is solved on the features of a frozen encoder; give --freeze")
    if args.head == "ridge" and args.heads not in (None, 1):
        parser.error("--heads: a ridge has one")
    if args.head == "ridge" and (args.loss != "l1" or args.weight_by_sigma):
        parser.error("--loss, --weight-by-sigma: a ridge is solved, not trained; give --head small")
    args.heads = args.heads or (1 if args.head == "ridge" else 5)
    args.size = args.size or encoders.native_size(args.encoder)
    args.epochs = args.epochs or (150 if args.freeze else 60)
    args.bank = args.bank or args.inputs / ".features"
    if args.lr is None:
        args.lr = 5e-4 if args.freeze else 10 * args.encoder_lr * args.batch / 256
    return args


def configuration(args, train, validation, test, weights: dict | None) -> dict:
    """Everything that fixes the run's result; `weights` is what `encoder_weights.read` gives."""
    chosen = ("encoder", "levels", "head", "heads", "size", "images", "freeze", "variants", "turn", "seed", "statuses", "target")
    of_epochs = ("epochs", "batch", "lr", "encoder_lr", "weight_decay", "loss", "weight_by_sigma")
    settings = {key: getattr(args, key) for key in chosen + (() if args.head == "ridge" else of_epochs)}
    views = [row.views for row in fitted(settings, train, validation)]
    low, high = PAPER_RANGE if args.range == "paper" else (int(min(views)), int(max(views)))
    if args.sizes is not None:
        settings["sizes"] = args.sizes
    return {
        **settings,
        "encoder_weights": weights and weights["fingerprint"],
        "range": [low, max(high, low + 1)],
        "trained_on": len(views),
        "rows": {"train": ids(train), "validation": ids(validation), "test": ids(test)},
    }


def fitted(config: dict, train, validation) -> list:
    """The rows that a network's weights come from. A ridge has no epoch to choose: once its error on the validation rows
    is known it is fitted to them too."""
    return train + validation if config["head"] == "ridge" else train


def ids(rows):
    return [row.id for row in rows]


def images_of(rng, mode) -> list[int]:
    if mode == "3":
        return list(range(INITIAL_IMAGES))
    return sorted(rng.permutation(MAX_IMAGES)[: rng.integers(1, MAX_IMAGES + 1)].tolist())


def evaluate(network, source, rows, device, variants=range(VALIDATION_VARIANTS)) -> float:
    """L1 of the mean of the heads on the three initial images, over variants (0 is the clean one)."""
    network.eval()
    errors, first = [], list(range(INITIAL_IMAGES))
    with torch.no_grad():
        for variant in variants:
            for start in range(0, len(rows), 64):
                part = rows[start : start + 64]
                answer = network(source.batch([(row, variant, first) for row in part]).to(device)).mean(1).cpu()
                errors.extend(np.abs(answer.numpy() - [row.views for row in part]))
    return float(np.mean(errors))


def epoch_of(network, source, rows, args, epoch, optimizer, scheduler, device) -> float:
    """One pass; all randomness comes from the seed and the epoch, so that a resumed run is the same run."""
    rng = np.random.default_rng([args.seed, epoch])
    torch.manual_seed(args.seed * 100003 + epoch)
    network.train()
    if args.freeze:
        network.encoder.eval()
    low, high = network.low, network.high
    order, total = rng.permutation(len(rows)), 0.0
    # A last batch of one row would break batch normalisation: it joins the one before.
    starts = [s for s in range(0, len(order), args.batch) if len(order) - s > 1 or s == 0]
    for index, start in enumerate(starts):
        end = len(order) if index + 1 == len(starts) else start + args.batch
        part = [rows[i] for i in order[start:end]]
        count = len(images_of(rng, args.images))
        items = []
        for row in part:
            chosen = list(range(INITIAL_IMAGES))
            if args.images != "3":
                chosen = rng.permutation(MAX_IMAGES)[:count].tolist()
            items.append((row, int(rng.integers(0, args.variants if args.freeze else 2**31)), chosen))
        target = torch.tensor([row.views for row in part], dtype=torch.float32, device=device)
        weight = torch.ones_like(target)
        if args.weight_by_sigma:
            weight = 1 / (3 + torch.tensor([row.sigma for row in part], dtype=torch.float32, device=device))
        answers = network(source.batch(items).to(device))
        errors = (answers - target.clamp(low, high).unsqueeze(1)).abs()
        losses = errors
        if args.loss == "huber":
            losses = torch.where(errors < HUBER_DELTA, errors**2 / (2 * HUBER_DELTA), errors - HUBER_DELTA / 2)
        loss = (losses.mean(1) * weight).sum() / weight.sum()
        optimizer.zero_grad(set_to_none=True)
        loss.backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), 20.0)
        optimizer.step()
        scheduler.step()
        total += float(errors.detach().mean(1).sum())
    return total / len(rows)


def optimizer_of(network, args, count):
    """Optimiser and learning rates for `count` rows."""
    groups = [{"params": network.heads.parameters(), "lr": args.lr}]
    if not args.freeze:
        groups.append({"params": network.encoder.parameters(), "lr": args.encoder_lr * args.batch / 256})
    optimizer = torch.optim.AdamW(groups, betas=(0.9, 0.95), weight_decay=args.weight_decay)
    steps = max(1, -(-count // args.batch)) * args.epochs
    warm = max(1, steps // 20)
    scheduler = torch.optim.lr_scheduler.LambdaLR(
        optimizer, lambda step: min((step + 1) / warm, 0.5 + 0.5 * math.cos(math.pi * min(1.0, step / steps)))
    )
    return optimizer, scheduler


def trained_state(network, config) -> dict:
    """What is kept of a network: a frozen encoder is what it started from, so only what was trained."""
    return (network.heads if config["freeze"] else network).state_dict()


def start(config: dict, run: Path) -> PRVNet:
    """The network of `config` before its first step, with the run's own encoder.pt where it has one."""
    network = PRVNet(config)
    if config.get("encoder_weights"):
        encoder_weights.load(network.encoder, config, run)
    return network


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
    where = {"labels": str(args.labels.resolve()), "inputs": str(args.inputs.resolve()), "bank": str(args.bank.resolve())}
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
    if args.freeze:
        network.encoder.requires_grad_(False)
        source = Bank(args.bank, args.inputs, train_rows + validation_rows, network, args.variants, device)
        torch.set_num_threads(1)  # the heads' matrices are too small to share
    else:
        source = Photos(args.inputs, train_rows + validation_rows, args.size)
    constant = metrics.l1(median, [row.views for row in validation_rows])
    print(f"{len(train_rows)} rows to train on, {len(validation_rows)} to choose by, {len(test_rows)} held out; "
          f"labels {config['range']}, validation L1 of the training median {constant:.2f}")  # fmt: skip
    by = solve if args.head == "ridge" else by_epochs
    by(network, source, train_rows, validation_rows, args, config, device)
    return config


def solve(network, source, train_rows, validation_rows, args, config, device):
    """A ridge's weights, fitted twice: for its error on the validation rows, and for good."""
    if (args.out / "best.pt").is_file():
        return
    begin = time.process_time()
    ridge.fit(network, source, train_rows, config)
    validation = evaluate(network, source, validation_rows, device)
    ridge.fit(network, source, fitted(config, train_rows, validation_rows), config)
    print(f"solved in {time.process_time() - begin:.0f} CPU seconds, validation L1 {validation:.2f}")
    save({"weights": trained_state(network, config), "config": config, "epoch": 1, "validation_l1": validation}, args.out / "best.pt")


def by_epochs(network, source, train_rows, validation_rows, args, config, device):
    """Gradient descent; keeps the network of the epoch with the least validation L1."""
    network.start_at(float(np.median([row.views for row in train_rows])))
    optimizer, scheduler = optimizer_of(network, args, len(train_rows))
    load = network.heads.load_state_dict if args.freeze else network.load_state_dict

    last, best, first_epoch = args.out / "last.pt", float("inf"), 0
    if last.is_file():
        state = torch.load(last, map_location=device, weights_only=True)
        load(state["weights"])
        optimizer.load_state_dict(state["optimizer"])
        scheduler.load_state_dict(state["scheduler"])
        best, first_epoch = state["best"], state["epoch"]

    log = args.out / "log.csv"
    if first_epoch == 0 or not log.is_file():
        log.write_text("epoch,train_l1,validation_l1,best,cpu_s\n")
    bar = tqdm(range(first_epoch, args.epochs), initial=first_epoch, total=args.epochs, unit="epoch")
    for epoch in bar:
        begin = time.process_time()
        error = epoch_of(network, source, train_rows, args, epoch, optimizer, scheduler, device)
        validation = evaluate(network, source, validation_rows, device)
        if validation < best:
            best = validation
            save({"weights": trained_state(network, config), "config": config, "epoch": epoch + 1, "validation_l1": best}, args.out / "best.pt")
        with open(log, "a", newline="") as file:
            cpu_s = time.process_time() - begin
            csv.writer(file).writerow([epoch + 1, f"{error:.4f}", f"{validation:.4f}", f"{best:.4f}", f"{cpu_s:.2f}"])
        # Frozen epochs take less time than writing the state does.
        if not args.freeze or (epoch + 1) % 10 == 0 or epoch + 1 == args.epochs:
            state = {"optimizer": optimizer.state_dict(), "scheduler": scheduler.state_dict()}
            save({"weights": trained_state(network, config), **state, "best": best, "epoch": epoch + 1}, last)
        bar.set_postfix(train=f"{error:.2f}", validation=f"{validation:.2f}", best=f"{best:.2f}")


def save(state, path: Path):
    partial = path.with_suffix(".part")
    torch.save(state, partial)
    partial.rename(path)


def load_best(run: Path, device="cpu") -> PRVNet:
    """The network of a run's best.pt, ready to be used."""
    state = torch.load(run / "best.pt", map_location=device, weights_only=True)
    config = state["config"]
    network = start(config, run) if config["freeze"] else PRVNet(config, pretrained=False)
    (network.heads if config["freeze"] else network).load_state_dict(state["weights"])
    return network.to(device).eval()


if __name__ == "__main__":
    train(arguments())
