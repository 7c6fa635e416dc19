"""Draws the model card's pictures: label distribution, example curves with their fits, easy and hard objects.

    python -m prvnet.pictures --labels models/labels.csv --inputs DIR --out models/pictures
"""

import argparse
import csv
import math
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image, ImageDraw  # noqa: E402

from .labels import KEY_COLUMNS  # noqa: E402

# The same bytes from the same labels.
matplotlib.rcParams["svg.hashsalt"] = "prvnet"
matplotlib.rcParams["svg.fonttype"] = "none"
EXAMPLES, EXTREMES, TILE = 10, 6, 160


def read(path: Path) -> list[dict]:
    with open(path, newline="") as file:
        return [line for line in csv.DictReader(file) if line["v_gain"]]


def curve_of(line: dict, views: np.ndarray) -> np.ndarray:
    """The fitted curve, dB, at `views`."""
    y0, amplitude, x_c, width = (float(line[key]) for key in ("y0", "amplitude", "x_c", "width"))
    z = np.log(views / x_c) / width
    return y0 + amplitude * 0.5 * (1 + np.vectorize(math.erf)(z / math.sqrt(2)))


def samples_of(line: dict) -> tuple[list[int], list[float]]:
    """Views and PSNR (dB), one pair a NeRF."""
    pairs = [(int(views), float(value)) for word in line["psnr_both_db"].split() for views, _, values in [word.partition(":")] for value in values.split("/")]  # fmt: skip
    return [v for v, _ in pairs], [p for _, p in pairs]


def save(figure, path: Path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def distribution(lines: list[dict], path: Path):
    figure, axes = plt.subplots(1, 3, figsize=(12, 3), sharey=True)
    for axis, (target, name) in zip(axes, (("v_gain", "v_gain"), ("v_near", "v_near"), ("v_star", "v* (paper)"))):
        values = [float(line[target]) for line in lines if line[target]]
        axis.hist(np.clip(values, 0, 100), bins=range(0, 102, 2), color="#4a7ab5")
        axis.set_xlabel(f"{name}, views (median {np.median(values):.0f})")
    axes[0].set_ylabel("labels")
    save(figure, path)


def curves(lines: list[dict], path: Path):
    """Ten labels at even ranks."""
    ordered = sorted(lines, key=lambda line: (float(line["v_gain"]), line["object"]))
    ranks = np.linspace(0.03, 0.97, EXAMPLES) * (len(ordered) - 1)
    figure, axes = plt.subplots(2, EXAMPLES // 2, figsize=(13, 5), sharex=True)
    grid = np.geomspace(4, 100, 200)
    for axis, rank in zip(axes.flat, ranks):
        line = ordered[int(round(rank))]
        axis.semilogx(*samples_of(line), "o", markersize=3, color="#333333")
        axis.semilogx(grid, curve_of(line, grid), color="#4a7ab5")
        axis.axvline(float(line["v_gain"]), color="#c0504d", linestyle="--", linewidth=1)
        axis.axvline(float(line["v_near"]), color="#7f9f3f", linestyle=":", linewidth=1)
        axis.set_title(f"{line['name'][:24]}: {line['v_gain']}", fontsize=8)
        axis.set_xticks([5, 10, 20, 50, 100], ["5", "10", "20", "50", "100"])
        axis.minorticks_off()
    figure.supxlabel("views (dashed v_gain, dotted v_near)", fontsize=9)
    figure.supylabel("PSNR over black and white, dB", fontsize=9)
    save(figure, path)


def easy_and_hard(lines: list[dict], inputs: Path, path: Path):
    """The objects of smallest and largest labels, as the network sees them from the front."""
    with open(inputs / "index.csv", newline="") as file:
        folders = {tuple(line[key] for key in KEY_COLUMNS): line["row"] for line in csv.DictReader(file)}
    with_crops = [line for line in lines if tuple(line[key] for key in KEY_COLUMNS) in folders]
    ordered = sorted(with_crops, key=lambda line: (float(line["v_gain"]), line["object"]))
    sheet = Image.new("RGB", (EXTREMES * TILE, 2 * (TILE + 16)), "white")
    draw = ImageDraw.Draw(sheet)
    for row, part in enumerate((ordered[:EXTREMES], ordered[-EXTREMES:])):
        for column, line in enumerate(part):
            folder = inputs / folders[tuple(line[key] for key in KEY_COLUMNS)]
            photo = Image.open(folder / "2.png").convert("RGBA").resize((TILE, TILE))
            place = (column * TILE, row * (TILE + 16))
            sheet.paste(photo, place, photo)
            draw.text((place[0] + 4, place[1] + TILE), f"{line['v_gain']}  {line['name'][:20]}", fill="black")
    sheet.save(path, optimize=True)


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--labels", type=Path, required=True)
    parser.add_argument("--inputs", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    args = parser.parse_args(argv)
    args.out.mkdir(parents=True, exist_ok=True)
    lines = read(args.labels)
    distribution(lines, args.out / "labels.svg")
    curves(lines, args.out / "curves.svg")
    easy_and_hard(lines, args.inputs, args.out / "objects.png")


if __name__ == "__main__":
    main()
