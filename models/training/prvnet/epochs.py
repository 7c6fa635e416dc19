"""Gradient descent: heads on a frozen encoder's features, or the whole network on photos made anew."""

import csv
import math
import time

import numpy as np
import torch
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn
from tqdm import tqdm

from . import INITIAL_IMAGES, MAX_IMAGES
from .runs import BEST, LAST, save, trained, tuned
from .sources import PLAIN_VARIANTS

VALIDATION_VARIANTS = 6

# Errors, views, below which the Huber loss is quadratic: about what two labels of one object differ by.
HUBER_DELTA = 2.0


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


class Descent:
    """A network on its way down, with its optimiser, learning rates and, where `args.averaging` is not 0, the running
    mean of its weights over the steps: that swings less from epoch to epoch than the weights do."""

    def __init__(self, network, args, count: int):
        """`count`: rows of an epoch."""
        self.network, self.args = network, args
        groups = [{"params": network.heads.parameters(), "lr": args.lr}]
        if not args.freeze:
            # Half the time of EfficientNet's on a CPU.
            network.encoder.to(memory_format=torch.channels_last)
            groups.append({"params": network.encoder.parameters(), "lr": args.encoder_lr * args.batch / 256})
        self.optimizer = torch.optim.AdamW(groups, betas=(0.9, 0.95), weight_decay=args.weight_decay)
        steps = max(1, -(-count // args.batch)) * args.epochs
        warm = max(1, steps // 20)
        self.scheduler = torch.optim.lr_scheduler.LambdaLR(
            self.optimizer, lambda step: min((step + 1) / warm, 0.5 + 0.5 * math.cos(math.pi * min(1.0, step / steps)))
        )
        # Buffers are not averaged but followed: batch normalisation's are running means already.
        self.mean = AveragedModel(network, multi_avg_fn=get_ema_multi_avg_fn(args.averaging)) if args.averaging else None

    @property
    def result(self):
        """The network that is judged and kept."""
        return self.mean.module if self.mean else self.network

    def step(self, loss):
        self.optimizer.zero_grad(set_to_none=True)
        loss.backward()
        torch.nn.utils.clip_grad_norm_(self.network.parameters(), 20.0)
        self.optimizer.step()
        self.scheduler.step()
        if self.mean:
            self.mean.update_parameters(self.network)

    def epoch(self, source, rows, epoch: int, device) -> float:
        """One pass; all randomness comes from the seed and the epoch, so that a resumed run is the same run."""
        args, network = self.args, self.network
        rng = np.random.default_rng([args.seed, epoch])
        torch.manual_seed(args.seed * 100003 + epoch)
        network.train()
        if args.freeze or args.head == "ridge":
            # A ridge was solved on features of the encoder at rest, batch normalisation included.
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
                variant = int(rng.integers(0, args.variants) if args.freeze else rng.integers(PLAIN_VARIANTS, 2**31))
                items.append((row, variant, chosen))
            target = torch.tensor([row.views for row in part], dtype=torch.float32, device=device)
            weight = torch.ones_like(target)
            if args.weight_by_sigma:
                weight = 1 / (3 + torch.tensor([row.sigma for row in part], dtype=torch.float32, device=device))
            answers = network(source.batch(items).to(device))
            errors = (answers - target.clamp(low, high).unsqueeze(1)).abs()
            losses = errors
            if args.loss == "huber":
                losses = torch.where(errors < HUBER_DELTA, errors**2 / (2 * HUBER_DELTA), errors - HUBER_DELTA / 2)
            self.step((losses.mean(1) * weight).sum() / weight.sum())
            total += float(errors.detach().mean(1).sum())
        return total / len(rows)

    def state(self, config: dict) -> dict:
        """Everything that a resumed run goes on from."""
        state = {"weights": trained(self.network, config).state_dict(), "optimizer": self.optimizer.state_dict(),
                 "scheduler": self.scheduler.state_dict()}  # fmt: skip
        if self.mean:
            state |= {"mean": trained(self.mean.module, config).state_dict(), "averaged": self.mean.n_averaged}
        return state

    def resume(self, state: dict, config: dict):
        trained(self.network, config).load_state_dict(state["weights"])
        self.optimizer.load_state_dict(state["optimizer"])
        self.scheduler.load_state_dict(state["scheduler"])
        if self.mean:
            trained(self.mean.module, config).load_state_dict(state["mean"])
            self.mean.n_averaged.copy_(state["averaged"])


def by_epochs(network, source, train_rows, validation_rows, args, config, device):
    """Gradient descent from where the network is; keeps that of the epoch with the least validation L1."""
    descent = Descent(network, args, len(train_rows))
    last, best, first_epoch = args.out / LAST, float("inf"), 0
    if last.is_file():
        state = torch.load(last, map_location=device, weights_only=True)
        descent.resume(state, config)
        best, first_epoch = state["best"], state["epoch"]

    def keep(epoch: int):
        weights = trained(descent.result, config).state_dict()
        save({"weights": weights, "config": config, "epoch": epoch, "validation_l1": best}, args.out / BEST)

    log = args.out / "log.csv"
    if first_epoch == 0 or not log.is_file():
        log.write_text("epoch,train_l1,validation_l1,best,cpu_s\n")
    if first_epoch == 0 and tuned(config):
        # Tuning has to better what it starts from.
        best = evaluate(network, source, validation_rows, device)
        keep(0)
        print(f"solved before the first epoch: validation L1 {best:.2f}")
    bar = tqdm(range(first_epoch, args.epochs), initial=first_epoch, total=args.epochs, unit="epoch")
    for epoch in bar:
        begin = time.process_time()
        error = descent.epoch(source, train_rows, epoch, device)
        validation = evaluate(descent.result, source, validation_rows, device)
        if validation < best:
            best = validation
            keep(epoch + 1)
        with open(log, "a", newline="") as file:
            cpu_s = time.process_time() - begin
            csv.writer(file).writerow([epoch + 1, f"{error:.4f}", f"{validation:.4f}", f"{best:.4f}", f"{cpu_s:.2f}"])
        # Frozen epochs take less time than writing the state does.
        if not args.freeze or (epoch + 1) % 10 == 0 or epoch + 1 == args.epochs:
            save({**descent.state(config), "best": best, "epoch": epoch + 1}, last)
        bar.set_postfix(train=f"{error:.2f}", validation=f"{validation:.2f}", best=f"{best:.2f}")
