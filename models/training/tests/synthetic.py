"""A made-up labels.csv with crops, on which the count can be learnt: finer checks need more views."""

import csv

import numpy as np
from PIL import Image

# A network that takes such crops and is small enough for tests.
CONFIG = {"encoder": "convnextv2_atto", "size": 64, "levels": "all", "head": "small", "heads": 2, "range": [13, 58]}

COLUMNS = ("object", "name", "category", "licence", "radius_m", "seed", "status", "v_gain", "v_gain_sigma", "v_near",
           "v_near_sigma", "v_star", "v_star_sigma", "draw")  # fmt: skip


def make(folder, objects=40, size=64, seed=0):
    """Writes labels.csv and inputs/ below `folder`."""
    rng = np.random.default_rng(seed)
    inputs = folder / "inputs"
    inputs.mkdir(parents=True)
    with open(folder / "labels.csv", "w", newline="") as table, open(inputs / "index.csv", "w", newline="") as index:
        table, index = csv.writer(table), csv.writer(index)
        table.writerow(COLUMNS)
        index.writerow(("row", "object", "radius_m", "seed"))
        for number in range(objects):
            name, radius = f"library/object-{number}", f"{rng.uniform(0.07, 0.12):.5f}"
            cells = int(rng.integers(2, size // 3))
            status = "not_converged" if number % 10 == 9 else "ok"
            views = "" if number == 0 else round(15 + 30 * cells / (size // 3) + rng.normal(0, 1))
            table.writerow((name, name, "", "CC0", radius, number, status, views, "1.50", views and views - 8, "1.00", views and views + 9, "3.00", 0))
            index.writerow((f"row-{number}", name, radius, number))
            (inputs / f"row-{number}").mkdir()
            for k in range(5):
                image = _ball(size, float(radius), cells, rng)
                Image.fromarray(image).save(inputs / f"row-{number}" / f"{k}.png")


def _ball(size, radius, cells, rng):
    color = Image.fromarray(rng.integers(0, 256, (cells, cells, 3), dtype=np.uint8))
    color = np.asarray(color.resize((size, size), Image.Resampling.NEAREST))
    axis = (np.arange(size) + 0.5) / size * 0.27 - 0.135
    inside = axis[None] ** 2 + axis[:, None] ** 2 < radius**2
    return np.dstack([color, (inside * 255).astype(np.uint8)])
