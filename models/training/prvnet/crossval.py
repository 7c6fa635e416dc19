"""Every object held out once: five runs whose test folds together are all objects.

    python -m prvnet.crossval --labels models/labels.csv --inputs DIR --out runs/crossval [options of prvnet.train]

Writes crossval.csv (one row a label: truth, network, training median, image statistics) and prints the errors.
"""

import csv
from pathlib import Path

import numpy as np
import torch

from . import INITIAL_IMAGES, baseline, labels, metrics
from .sources import Photos
from .splits import split
from .train import arguments, load_best, train

TURNS = 5
COLUMNS = ("row", "object", "group", "truth", "network", "median", "statistics")


def table(args) -> list[dict]:
    rows = labels.read(args.labels, args.inputs, args.statuses.split(","), args.target)
    out, result = args.out, []
    for turn in range(TURNS):
        known, validation, test = split(rows, turn)
        if not test:
            continue
        args.turn, args.out = turn, out / f"turn-{turn}"
        train(args)
        network = load_best(args.out)
        photos = Photos(args.inputs, test, args.size)
        statistics = baseline.evaluate(args.inputs, rows, turn)
        median = float(np.median([row.views for row in known + validation]))
        for row, from_statistics in zip(test, statistics):
            with torch.no_grad():
                answer = float(network(photos.get(row, 0)[None, :INITIAL_IMAGES]).mean())
            values = (row.id, row.object, row.group, row.views, answer, median, float(from_statistics))
            result.append(dict(zip(COLUMNS, values)))
    args.out = out
    return result


def read(path: Path) -> list[dict]:
    with open(path, newline="") as file:
        return [
            {key: value if key in ("row", "object", "group") else float(value) for key, value in line.items()}
            for line in csv.DictReader(file)
        ]


def summary(lines) -> list[tuple[str, str]]:
    """(what, L1 with its interval) for the network and for what it must beat."""
    truth, groups = [line["truth"] for line in lines], [line["group"] for line in lines]
    errors = {key: np.abs(np.array([line[key] for line in lines]) - truth) for key in COLUMNS[4:]}
    names = {"network": "PRVNet", "median": "median of the training labels", "statistics": "regression on image statistics"}
    figures = [(names[key], metrics.with_interval(errors[key], groups)) for key in names]
    return [*figures, ("PRVNet less the median", metrics.with_interval(errors["network"] - errors["median"], groups))]


def main():
    args = arguments()
    lines = table(args)
    with open(args.out / "crossval.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(lines)
    print(f"{len(lines)} rows, each held out once; L1 in views with 95 % interval")
    for name, figure in summary(lines):
        print(f"{name:32} {figure}")


if __name__ == "__main__":
    main()
