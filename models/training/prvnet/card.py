"""Measures the model file on the held-out objects and writes the figures into the model card.

    python -m prvnet.card --run runs/x --model models/prvnet.onnx --card models/MODEL_CARD.md

The figures stand between two marks in the card; what is around them is written by hand.
"""

import argparse
import csv
import json
from collections import Counter
from pathlib import Path

import numpy as np

from . import INITIAL_IMAGES, MAX_IMAGES, augment, baseline, calibrate, interval, labels, metrics, novelty_card, repeatability
from .onnx_model import OnnxModel
from .runs import fitted
from .sources import Photos, all_subsets, shoot_seed

BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"
SHOOTS = 8


def status_line(path: Path) -> str:
    with open(path, newline="") as file:
        counts = Counter(line["status"] for line in csv.DictReader(file))
    return ", ".join(f"{count} `{status}`" for status, count in counts.most_common())


def figures(model: OnnxModel, config: dict, labels_path: Path, inputs: Path) -> str:
    rows = labels.read(labels_path, inputs, config["statuses"].split(","), config["target"], config.get("sizes"))
    by_id = {row.id: row for row in rows}
    train, validation, test = ([by_id[id] for id in config["rows"][part]] for part in ("train", "validation", "test"))
    truth, groups = np.array([row.views for row in test]), [row.group for row in test]
    photos = Photos(inputs, test, int(model.metadata["prv.input_size"]))
    clean = [photos.get(row, 0).numpy() for row in test]

    def error(predicted) -> str:
        return metrics.with_interval(np.abs(np.asarray(predicted) - truth), groups)

    initial = np.array([model.predict(images[:INITIAL_IMAGES]) for images in clean])
    answers_to_shoots = np.array(
        [[model.answer(photos.get(row, 1 + v)[:INITIAL_IMAGES].numpy()) for v in range(SHOOTS)] for row in test]
    )
    shoots, shoots_novelty = answers_to_shoots[..., 0], answers_to_shoots[..., 1]
    known = np.array([row.views for row in fitted(config, train, validation)])
    all_views = np.array([row.views for row in rows])
    quantiles = np.quantile(all_views, [0, 0.1, 0.25, 0.5, 0.75, 0.9, 1])
    lines = [
        f"Labels: {status_line(labels_path)}; used are {len(rows)} rows of {len({r.group for r in rows})} objects: "
        f"{config['trained_on']} to train, {len(train + validation) - config['trained_on']} to choose by, {len(test)} held out.",
        "",
        f"{config['target']} (min, 10 %, 25 %, median, 75 %, 90 %, max): " + ", ".join(f"{q:.0f}" for q in quantiles) + ". "
        f"Mean standard deviation of a label: {np.mean([row.sigma for row in rows]):.1f} views.",
        "",
        "| held-out objects, three initial photos | L1, views [95 % interval] |",
        "|---|---|",
        f"| **PRVNet** ({config['encoder']}, ONNX) | **{error(initial)}** |",
        f"| best constant on the held-out objects themselves ({np.median(truth):.0f}) | {error(np.median(truth))} |",
        f"| median of the training labels ({np.median(known):.0f}) | {error(np.median(known))} |",
        f"| regression on image statistics | {error(baseline.evaluate(inputs, rows, config['turn']))} |",
        f"| PRVNet, random backgrounds, light and camera ({SHOOTS} shoots) | "
        f"{metrics.with_interval(np.abs(shoots - truth[:, None]).mean(1), groups)} |",
        f"| the objects it was chosen by | {of_validation(model, inputs, validation)} |",
        "",
        *movement(test, np.abs(shoots - initial[:, None])),
        "",
        "| photos | L1, mean over every choice of that many of the five |",
        "|---|---|",
    ]
    for count in range(1, MAX_IMAGES + 1):
        answers = np.array([[model.predict(images[choice]) for choice in all_subsets(count)] for images in clean])
        lines.append(f"| {count} | {metrics.with_interval(np.abs(answers - truth[:, None]).mean(1), groups)} |")
    lines += ["", *coverage(model, truth, initial, shoots), "", *novelty_card.lines(model, clean, shoots_novelty)]
    return "\n".join(lines)


def of_validation(model: OnnxModel, inputs: Path, rows) -> str:
    photos = Photos(inputs, rows, int(model.metadata["prv.input_size"]))
    predicted = np.array([model.predict(photos.get(row, 0)[:INITIAL_IMAGES].numpy()) for row in rows])
    return metrics.with_interval(np.abs(predicted - [row.views for row in rows]), [row.group for row in rows])


def movement(rows, moved: np.ndarray) -> list[str]:
    """How far the answer to random shoots [rows, SHOOTS] is from that to the clean photos, by what is behind the object."""
    kinds = np.array([[scene_kind(row, 1 + v) for v in range(SHOOTS)] for row in rows])
    parts = {"all": np.full(kinds.shape, True), "white (masked): light, camera and placement alone": kinds == "white"}
    parts |= {f"{kind}, and light, camera and placement": kinds == kind for kind in sorted(set(kinds.ravel()) - {"white"})}
    lines = ["| random shoots, by background | sets | the answer moves by, mean | by at most 2 views | at most |", "|---|---|---|---|---|"]
    for name, part in parts.items():
        far = moved[part]
        if len(far):
            lines.append(f"| {name} | {len(far)} | {far.mean():.2f} views | {100 * np.mean(far <= 2):.1f} % | {far.max():.1f} views |")
    return lines


def scene_kind(row, variant: int) -> str:
    return str(augment.Scene(np.random.default_rng(shoot_seed(row, variant))).kind)


def coverage(model: OnnxModel, truth, initial, shoots) -> list[str]:
    """How many held-out labels lie in their interval, which was fitted on none of them."""

    def inside(answers):
        ends = np.array([model.interval(answer) for answer in answers])
        return (ends[:, 0] <= truth) & (truth <= ends[:, 1]), np.mean(ends[:, 1] - ends[:, 0])

    held, width = inside(initial)
    on_shoots = np.mean([inside(shoots[:, v])[0] for v in range(shoots.shape[1])])
    low, high = (float(model.metadata[f"prv.interval_{end}"]) for end in ("low", "high"))
    return [
        f"The {100 * interval.LEVEL:.0f} % interval reaches from {low:+.1f} to {high:+.1f} views about the answer, by the "
        f"errors on {model.metadata['prv.interval_objects']} objects (none held out) in networks not trained on them. "
        f"Of the held-out labels {held.sum()} of {len(held)} lie inside, {interval.share_with_interval(held.sum(), len(held))} "
        f"(95 % interval); {100 * on_shoots:.0f} % with random backgrounds, light and camera. Mean width {width:.0f} views.",
    ]


def every_object_once(sisters: list[Path], config: dict, labels_path: Path, inputs: Path) -> str:
    """What runs of one recipe say of all objects, each asked of those that it holds out."""
    rows = labels.read(labels_path, inputs, config["statuses"].split(","), config["target"], config.get("sizes"))
    errors, groups = np.abs(calibrate.sisters_residuals(sisters, config, inputs, rows)), [row.group for row in rows]
    constant = {}
    for sister in sisters:
        parts = json.loads((sister / "config.json").read_text())["rows"]
        held_out = set(parts["test"])
        median = np.median([row.views for row in rows if row.id not in held_out])
        constant |= {row.id: abs(row.views - median) for row in rows if row.id in held_out}
    return (
        f"Every object held out once, by {len(sisters)} networks of this recipe, {len(rows)} labels: L1 "
        f"**{metrics.with_interval(errors[:, 0], groups)}** views, over random backgrounds, light and camera "
        f"{metrics.with_interval(errors[:, 1:].mean(1), groups)}; median of the labels that each has not held out "
        f"{metrics.with_interval([constant[row.id] for row in rows], groups)}."
    )


def update(card: Path, text: str):
    """Puts `text` between the marks; a card without marks gets them at its end."""
    old = card.read_text() if card.is_file() else "# Model card of PRVNet\n"
    if BEGIN not in old:
        old = f"{old.rstrip()}\n\n{BEGIN}\n{END}\n"
    head, rest = old.split(BEGIN, 1)
    tail = rest.split(END, 1)[1]
    card.write_text(f"{head}{BEGIN}\n{text}\n{END}{tail}")


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", type=Path, required=True)
    parser.add_argument("--model", type=Path, required=True)
    parser.add_argument("--labels", type=Path, help="default: what the run was trained on")
    parser.add_argument("--inputs", type=Path, help="default: what the run was trained on")
    parser.add_argument("--repeats", type=Path, help="labels of the same objects measured again")
    parser.add_argument("--sisters", type=Path, nargs="+", help="the runs of all turns: every object held out once")
    parser.add_argument("--card", type=Path, help="the file to update; without it the figures are only printed")
    args = parser.parse_args(argv)
    config = json.loads((args.run / "config.json").read_text())
    where = json.loads((args.run / "where.json").read_text())
    labels_path, inputs = args.labels or Path(where["labels"]), args.inputs or Path(where["inputs"])
    text = figures(OnnxModel(args.model), config, labels_path, inputs)
    if args.sisters:
        text += "\n\n" + every_object_once(args.sisters, config, labels_path, inputs)
    if args.repeats and args.repeats.is_file():
        text += "\n\n" + "\n".join(repeatability.lines(labels_path, args.repeats))
    print(text)
    if args.card:
        update(args.card, text)


if __name__ == "__main__":
    main()
