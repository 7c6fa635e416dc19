"""labels.csv (written by `prv label`) joined with the crops (written by `prv inputs`)."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from . import MAX_IMAGES
from .splits import group_of

# What makes a row of labels.csv one of a kind, as text, so that no rounding can separate the two files.
KEY_COLUMNS = ("object", "radius_m", "seed")

# What can be predicted: where one more view gains too little (the label), how many views come near the object's own
# best, and the paper's definition.
TARGETS = ("v_gain", "v_near", "v_star")


@dataclass(frozen=True)
class Row:
    """One labelled object at one size."""

    id: str
    """Name of the folder with its crops."""
    object: str
    group: str
    """What splits go by: the object without size and variant."""
    radius_m: float
    views: float
    """The label: the views it needs."""
    sigma: float
    """Standard deviation of `views`."""


def read(labels: Path, inputs: Path, statuses=("ok",), target="v_gain", sizes: int | None = None) -> list[Row]:
    """The rows that have a label of one of `statuses` and a full set of crops, ordered by id; of the first `sizes` sizes
    of each object, or of all."""
    with open(inputs / "index.csv", newline="") as file:
        ids = {tuple(line[column] for column in KEY_COLUMNS): line["row"] for line in csv.DictReader(file)}
    rows, without_crops = [], 0
    with open(labels, newline="") as file:
        for line in csv.DictReader(file):
            if line["status"] not in statuses or not line[target]:
                continue
            if sizes is not None and int(line["draw"]) >= sizes:
                continue
            id = ids.get(tuple(line[column] for column in KEY_COLUMNS))
            if id is None or not all((inputs / id / f"{k}.png").is_file() for k in range(MAX_IMAGES)):
                without_crops += 1
                continue
            rows.append(
                Row(
                    id=id,
                    object=line["object"],
                    group=group_of(line["object"]),
                    radius_m=float(line["radius_m"]),
                    views=float(line[target]),
                    sigma=float(line[f"{target}_sigma"] or 0.0),
                )
            )
    if without_crops:
        print(f"{without_crops} labelled rows have no crops in {inputs}; run `make inputs`")
    if not rows:
        raise SystemExit(f"{labels}: no row with status {' or '.join(statuses)} and crops in {inputs}")
    return sorted(rows, key=lambda row: row.id)


def photographed(inputs: Path) -> list[Row]:
    """Every row with a full set of crops, labelled or not, ordered by id; `views` and `sigma` are NaN."""
    with open(inputs / "index.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    rows = [
        Row(line["row"], line["object"], group_of(line["object"]), float(line["radius_m"]), math.nan, math.nan)
        for line in lines
        if all((inputs / line["row"] / f"{k}.png").is_file() for k in range(MAX_IMAGES))
    ]
    if not rows:
        raise SystemExit(f"{inputs}: no row has crops; run `make inputs`")
    return sorted(rows, key=lambda row: row.id)


def crops(inputs: Path, row: Row) -> np.ndarray:
    """The row's crops, [5, S, S, 4] bytes, straight alpha."""
    images = [np.asarray(Image.open(inputs / row.id / f"{k}.png").convert("RGBA")) for k in range(MAX_IMAGES)]
    return np.stack(images)
