"""What a run's answers are worth: errors on objects left out, and what photos of them look like.

Both come from the objects that the run trained on or chose by, never from those held out.
"""

import argparse
import csv
import json
import math
from pathlib import Path

import numpy as np
import torch
from tqdm import tqdm

from . import INITIAL_IMAGES, novelty, ridge
from .epochs import VALIDATION_VARIANTS, Descent, evaluate
from .files import whole
from .model import PRVNet
from .runs import BEST, finished, fitted, load_best, solved, start, trained, tuned
from .sources import Bank, Photos
from .splits import FOLDS, fold_of

TURNS = 5
# Epochs without a better one after which a network is taken as it was best: heads are at theirs within twenty.
PATIENCE = 40


def source_of(run: Path, config: dict, inputs: Path, bank: Path, rows):
    """What the recipe trains from."""
    if config["freeze"]:
        return features_of(run, config, inputs, bank, rows)
    turned = json.loads((run / "where.json").read_text()).get("turned", [])
    return Photos(inputs, rows, config["size"], [Path(folder) for folder in turned])


def features_of(run: Path, config: dict, inputs: Path, bank: Path, rows) -> Bank:
    """Features of the encoder as the run started with it, which a ridge is solved on."""
    return Bank(bank, inputs, rows, start(config, run), config["variants"], torch.device("cpu"))


def answers_to_shoots(network: PRVNet, source, row) -> np.ndarray:
    """[shoots] answers to three photos of a row."""
    network.eval()
    with torch.no_grad():
        items = [(row, variant, list(range(INITIAL_IMAGES))) for variant in range(VALIDATION_VARIANTS)]
        return network(source.batch(items)).mean(1).numpy()


def left_out_answers(run: Path, config: dict, source, features, rows, turns: int = TURNS) -> np.ndarray:
    """[rows, shoots] answers to `rows`, each by a network of the same recipe that was not trained on its object.

    Of ten folds by object each network has two left out and one to choose by, as the run itself.
    """
    answers = np.full((len(rows), VALIDATION_VARIANTS), np.nan)
    fold = np.array([fold_of("interval " + row.group) for row in rows])
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
                ridge.fit(network, features, learnt, settings)
            else:
                network.start_at(float(np.median(views)))
            if solved(config):
                bar.update()
            else:
                network.encoder.requires_grad_(not config["freeze"])
                train_until_best(network, source, known, validation or known, settings, bar)
            for index in out:
                answers[index] = answers_to_shoots(network, source, rows[index])
    return answers


def train_until_best(network, source, known, validation, settings: dict, bar):
    """Epochs as in a run, until none has been better on `validation` for a while; leaves the best one's weights."""
    device = torch.device("cpu")
    descent = Descent(network, argparse.Namespace(**settings), len(known))

    def weights():
        return {key: value.clone() for key, value in trained(descent.result, settings).state_dict().items()}

    best, best_epoch, kept = math.inf, 0, None
    if tuned(settings):
        best, kept = evaluate(network, source, validation, device), weights()
    for epoch in range(settings["epochs"]):
        descent.epoch(source, known, epoch, device)
        error = evaluate(descent.result, source, validation, device)
        if error < best:
            best, best_epoch = error, epoch
            kept = weights()
        bar.update()
        if epoch - best_epoch >= PATIENCE:
            break
    trained(network, settings).load_state_dict(kept)


def residuals(run: Path, config: dict, source, features, rows, turns: int = TURNS) -> np.ndarray:
    """[rows, shoots] labels less answers; kept in the run's residuals.csv, which is used if it is of these rows."""
    return kept(run / "residuals.csv", rows, lambda: left_out_answers(run, config, source, features, rows, turns))


def sisters_residuals(sisters: list[Path], config: dict, inputs: Path, rows) -> np.ndarray:
    """[rows, shoots] labels less answers, each by the one of `sisters` that holds its object out: runs that differ in
    nothing but the turn. Each keeps its own in its held_out.csv."""
    table, place = np.full((len(rows), VALIDATION_VARIANTS), np.nan), {row.id: k for k, row in enumerate(rows)}
    for sister in sisters:
        settings = json.loads((sister / "config.json").read_text())
        if recipe_of(settings) != recipe_of(config):
            raise SystemExit(f"{sister} is a run of another recipe")
        held_out = set(settings["rows"]["test"])
        # In one order, whoever asks, so that the file is found to be of these rows.
        own = sorted((row for row in rows if row.id in held_out), key=lambda row: row.id)
        if not own:
            continue
        if len(own) != len(held_out):
            raise SystemExit(f"{sister} holds objects out that this run does as well, or of other labels")
        if not finished(sister, settings):
            raise SystemExit(f"{sister} has not been trained to its end")
        answers = sister / "held_out.csv"
        if answers.is_file() and answers.stat().st_mtime < (sister / BEST).stat().st_mtime:
            # Of weights that the run has left behind.
            answers.unlink()
        table[[place[row.id] for row in own]] = kept(answers, own, lambda: answers_of(sister, inputs, own))
    missing = int(np.isnan(table).any(1).sum())
    if missing:
        raise SystemExit(f"{missing} of {len(rows)} rows are held out by none of the other runs")
    return table


def recipe_of(config: dict) -> dict:
    """The settings that all turns share."""
    return {key: value for key, value in config.items() if key not in ("turn", "rows", "range", "trained_on", "encoder_weights")}


def answers_of(run: Path, inputs: Path, rows) -> np.ndarray:
    """[rows, shoots] answers of the run's network to three photos."""
    network = load_best(run)
    photos = Photos(inputs, rows, network.config["size"])
    return np.array([answers_to_shoots(network, photos, row) for row in tqdm(rows, "held out", leave=False)])


def kept(path: Path, rows, make) -> np.ndarray:
    """[rows, shoots] labels less answers: out of the file if it is of these rows, else of what `make` answers."""
    if path.is_file():
        with open(path, newline="") as file:
            lines = list(csv.reader(file))[1:]
        if [(line[0], float(line[1])) for line in lines] == [(row.id, row.views) for row in rows]:
            return np.array([[float(row.views) - float(answer) for answer in line[2:]] for row, line in zip(rows, lines)])
    answers = make()
    with whole(path) as partial, open(partial, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("row", "label", *(f"shoot_{k}" for k in range(answers.shape[1]))))
        writer.writerows((row.id, row.views, *(f"{a:.3f}" for a in line)) for row, line in zip(rows, answers))
    return np.array([[row.views] for row in rows]) - answers


def novelty_of(network: PRVNet, inputs: Path, rows) -> novelty.Novelty:
    """The score of the network's photos."""
    early = novelty.early_features(network.encoder)

    def features(photos) -> np.ndarray:
        with torch.no_grad():
            return network.encode(torch.from_numpy(photos)[None])[0, :, :early].numpy()

    return novelty.fit_to_shoots(features, inputs, rows, network.config["size"])
