"""The honest lower bar: ridge regression of the view count on plain statistics of the crops.

    python -m prvnet.baseline --labels labels.csv --inputs DIR
"""

import argparse
import io
from pathlib import Path

import numpy as np
from PIL import Image

from . import INITIAL_IMAGES, labels, metrics
from .augment import on_white
from .splits import fold_of, split

LAMBDAS = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0)


def statistics(crop: np.ndarray) -> np.ndarray:
    """Size, colour spread, detail at several scales and compressibility of one crop [S, S, 4] of bytes."""
    alpha = crop[..., 3].astype(np.float32) / 255
    covered = float(alpha.mean()) + 1e-6
    image = on_white(crop)
    grey = image.mean(-1)
    mean = (image * alpha[..., None]).sum((0, 1)) / alpha.sum().clip(1)
    spread = np.sqrt((((image - mean) ** 2) * alpha[..., None]).sum((0, 1)) / alpha.sum().clip(1))
    values = [np.log(covered), *spread, float(np.abs(mean - mean.mean()).max()), float(mean.mean())]
    for _ in range(4):
        across = np.abs(np.diff(grey, axis=1)).mean() + np.abs(np.diff(grey, axis=0)).mean()
        values.append(np.log(across / covered + 1e-4))
        side = grey.shape[0] // 2
        grey = grey[: 2 * side, : 2 * side].reshape(side, 2, side, 2).mean((1, 3))
    outline = np.abs(np.diff(alpha, axis=1)).mean() + np.abs(np.diff(alpha, axis=0)).mean()
    values.append(np.log(outline / covered + 1e-4))
    inside = (image.mean(-1) * 31).astype(int)[alpha > 0.5]
    share = np.bincount(inside, minlength=32) / max(1, inside.size)
    values.append(float(-(share[share > 0] * np.log(share[share > 0])).sum()))
    buffer = io.BytesIO()
    Image.fromarray((image * 255 + 0.5).astype(np.uint8)).save(buffer, "JPEG", quality=75)
    values.append(np.log(buffer.tell() / covered))
    return np.array(values, np.float64)


def features(inputs: Path, rows) -> np.ndarray:
    """Mean and spread of the statistics over the initial photos, and the object's radius."""
    table = []
    for row in rows:
        each = np.stack([statistics(crop) for crop in labels.crops(inputs, row)[:INITIAL_IMAGES]])
        table.append(np.concatenate([each.mean(0), each.std(0), [row.radius_m]]))
    return np.array(table)


def fit_predict(x, y, groups, x_new) -> np.ndarray:
    """Ridge with the penalty chosen by cross-validation over `groups`."""
    mean, deviation = x.mean(0), x.std(0) + 1e-9
    x, x_new = (x - mean) / deviation, (x_new - mean) / deviation

    def solve(x, y, penalty):
        weights = np.linalg.solve(x.T @ x + penalty * np.eye(x.shape[1]), x.T @ (y - y.mean()))
        return weights, y.mean()

    folds = np.array([fold_of("inner " + group) % 5 for group in groups])

    def error(penalty):
        errors = []
        for fold in set(folds):
            weights, offset = solve(x[folds != fold], y[folds != fold], penalty)
            errors.extend(np.abs(x[folds == fold] @ weights + offset - y[folds == fold]))
        return np.mean(errors)

    weights, offset = solve(x, y, min(LAMBDAS, key=error))
    return np.clip(x_new @ weights + offset, y.min(), y.max())


def evaluate(inputs: Path, rows, turn: int = 0) -> np.ndarray:
    """Predictions for the test rows of `splits.split(rows, turn)`, fitted on all others."""
    train, validation, test = split(rows, turn)
    known = train + validation
    y = np.array([row.views for row in known])
    return fit_predict(features(inputs, known), y, [row.group for row in known], features(inputs, test))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--labels", type=Path, required=True)
    parser.add_argument("--inputs", type=Path, required=True)
    args = parser.parse_args()
    rows = labels.read(args.labels, args.inputs)
    errors, constant, groups = [], [], []
    for turn in range(5):
        train, validation, test = split(rows, turn)
        if not test:
            continue
        y = np.array([row.views for row in test])
        errors.extend(np.abs(evaluate(args.inputs, rows, turn) - y))
        constant.extend(np.abs(np.median([row.views for row in train + validation]) - y))
        groups.extend(row.group for row in test)
    print(f"{len(rows)} rows, five test splits; L1 in views with 95 % interval")
    print(f"regression on image statistics {metrics.with_interval(errors, groups)}")
    print(f"median of the training labels  {metrics.with_interval(constant, groups)}")


if __name__ == "__main__":
    main()
