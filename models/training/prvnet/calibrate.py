"""What a run's answers are worth: errors on objects left out, and what photos of them look like.

Both come from the objects that the run trained on or chose by, never from those held out.
"""

import argparse
import csv
import math
from pathlib import Path

import numpy as np
import torch
from tqdm import tqdm

from . import INITIAL_IMAGES, MAX_IMAGES, novelty, ridge
from .model import PRVNet
from .sources import Bank, Photos
from .splits import FOLDS, fold_of
from .train import VALIDATION_VARIANTS, epoch_of, evaluate, fitted, optimizer_of, start, trained_state

TURNS = 5
# Epochs without a better one after which a network is taken as it was best: heads are at theirs within twenty.
PATIENCE = 40


def source_of(config, inputs: Path, bank: Path, rows, network):
    if config["freeze"]:
        return Bank(bank, inputs, rows, network, config["variants"], torch.device("cpu"))
    return Photos(inputs, rows, config["size"])


def left_out_answers(run: Path, config: dict, source, rows, turns: int = TURNS) -> np.ndarray:
    """[rows, shoots] answers to `rows`, each by a network of the same recipe that was not trained on its object.

    Of ten folds by object each network has two left out and one to choose by, as the run itself.
    """
    answers = np.full((len(rows), VALIDATION_VARIANTS), np.nan)
    fold = np.array([fold_of("interval " + row.group) for row in rows])
    first = list(range(INITIAL_IMAGES))
    with tqdm(unit="epoch", desc="left out") as bar:
        for turn in range(turns):
            tested = fold * turns // FOLDS == turn
            # The fold after those left out.
            chosen = fold == (-(-FOLDS * (turn + 1) // turns)) % FOLDS
            known = [row for row, out in zip(rows, tested | chosen) if not out]
            validation = [row for row, is_chosen in zip(rows, chosen & ~tested) if is_chosen]
            out = np.flatnonzero(tested)
            if len(known) < 2 or not len(out):
                raise SystemExit(f"{len(rows)} rows are too few to leave some out {turns} times")
            learnt = fitted(config, known, validation)
            views = [row.views for row in learnt]
            low = int(min(views))
            settings = {**config, "range": [low, max(int(max(views)), low + 1)]}
            torch.manual_seed(config["seed"] + 1 + turn)
            network = start(settings, run)
            if config["head"] == "ridge":
                ridge.fit(network, source, learnt, settings)
                bar.update()
            else:
                network.start_at(float(np.median(views)))
                network.encoder.requires_grad_(not config["freeze"])
                train_until_best(network, source, known, validation or known, settings, bar)
            network.eval()
            with torch.no_grad():
                for index in out:
                    items = [(rows[index], variant, first) for variant in range(VALIDATION_VARIANTS)]
                    answers[index] = network(source.batch(items)).mean(1).numpy()
    return answers


def train_until_best(network, source, known, validation, settings: dict, bar):
    """Epochs as in a run, until none has been better on `validation` for a while; leaves the best one's weights."""
    args, device = argparse.Namespace(**settings), torch.device("cpu")
    optimizer, scheduler = optimizer_of(network, args, len(known))
    best, best_epoch, kept = math.inf, 0, None
    for epoch in range(settings["epochs"]):
        epoch_of(network, source, known, args, epoch, optimizer, scheduler, device)
        error = evaluate(network, source, validation, device)
        if error < best:
            best, best_epoch = error, epoch
            kept = {key: value.clone() for key, value in trained_state(network, settings).items()}
        bar.update()
        if epoch - best_epoch >= PATIENCE:
            break
    (network.heads if settings["freeze"] else network).load_state_dict(kept)


def residuals(run: Path, config: dict, source, rows, turns: int = TURNS) -> np.ndarray:
    """[rows, shoots] labels less answers; kept in the run's residuals.csv, which is used if it is of these rows."""
    path, ids = run / "residuals.csv", [row.id for row in rows]
    if path.is_file():
        with open(path, newline="") as file:
            lines = list(csv.reader(file))[1:]
        if [(line[0], float(line[1])) for line in lines] == [(row.id, row.views) for row in rows]:
            return np.array([[float(row.views) - float(answer) for answer in line[2:]] for row, line in zip(rows, lines)])
    answers = left_out_answers(run, config, source, rows, turns)
    partial = path.with_suffix(".part")
    with open(partial, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("row", "label", *(f"shoot_{k}" for k in range(answers.shape[1]))))
        writer.writerows((id, row.views, *(f"{a:.3f}" for a in line)) for id, row, line in zip(ids, rows, answers))
    partial.rename(path)
    return np.array([[row.views] for row in rows]) - answers


def novelty_of(network: PRVNet, source, rows, variants: int) -> novelty.Novelty:
    """The score, fitted to the shoots of `rows`."""
    early = novelty.early_features(network.encoder)
    every, table = list(range(MAX_IMAGES)), []
    with torch.no_grad():
        for row in rows:
            batch = source.batch([(row, variant, every) for variant in range(variants)])
            features = batch if batch.ndim == 3 else network.encode(batch)
            table.append(features[..., :early].numpy())
    return novelty.fit(np.stack(table), [row.group for row in rows])
