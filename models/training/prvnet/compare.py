"""Trains a list of recipes on the same labels and tells which is best.

    python -m prvnet.compare --labels models/labels.csv --inputs DIR --out runs/compare

Each recipe is trained with every seed and, with --turns 5, with every object held out once. The choice goes by the
validation L1 (random shoots of the objects chosen by) among networks that answer in time. Writes compare.csv and
compare.md. May be stopped and started again: finished recipes, and finished runs of others, stay.
"""

import argparse
import csv
import json
import time
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path

import numpy as np
import torch

from . import INITIAL_IMAGES, baseline, labels, metrics, pretrain, recipes
from .files import whole
from .latency import of_network
from .runs import load_best
from .sources import Photos
from .splits import TURNS, split
from .train import arguments as train_arguments
from .train import train

COLUMNS = ("recipe", "parameters", "validation_l1", "validation_constant_l1", "held_out_l1", "held_out_low",
           "held_out_high", "held_out_rows", "train_cpu_s", "latency_1_thread_ms", "latency_2_threads_ms",
           "cpu_1_thread_ms")  # fmt: skip
RESULT = "result.json"


def arguments(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--labels", type=Path, required=True, help="labels.csv of `prv label`")
    add("--inputs", type=Path, required=True,
        help="folder of `prv inputs`; a recipe of size 260 takes the folder of the same name with -260 where it is there")  # fmt: skip
    add("--out", type=Path, required=True, help="folder of the comparison")
    add("--recipes", type=Path, default=recipes.DEFAULT, help="file of recipes")
    add("--only", help="names of the recipes to run, by commas; slow ones too")
    add("--slow", action="store_true", help="run the slow recipes as well")
    add("--seeds", type=int, default=1, help="seeds a recipe")
    add("--turns", type=int, choices=(1, TURNS), default=1, help="5: every object is held out once")
    add("--target", choices=labels.TARGETS, default="v_gain")
    add("--statuses", default="ok", help="label statuses to train on, by commas")
    add("--sizes", type=int, help="learn from the first of each object's sizes alone (default: from all)")
    add("--latency-ms", type=float, default=40.0, help="bound of three images on two threads for the choice")
    add("--latency-again", action="store_true", help="time finished recipes once more, as on a quiet machine")
    return parser.parse_args(argv)


@contextmanager
def clock(path: Path):
    """Adds the CPU seconds spent inside to those in the file, also when it is left by an interrupt."""
    begin = time.process_time()
    try:
        yield
    finally:
        before = float(path.read_text()) if path.is_file() else 0.0
        path.write_text(f"{before + time.process_time() - begin:.2f}")


def pretrained(recipe, args, turn: int) -> Path:
    """encoder.pt of the recipe's pre-training, which has seen nothing that the turn holds out or chooses by."""
    out = args.out / "pretrain" / recipes.folder_of(recipe.pretraining) / f"turn-{turn}"
    given = ["--inputs", args.inputs, "--out", out, "--turn", turn, "--device", "cpu"]
    given += recipes.flags(recipe.pretraining_options)
    out.mkdir(parents=True, exist_ok=True)
    with clock(out / "cpu_s"):
        return pretrain.pretrain(pretrain.arguments([str(word) for word in given]))


def train_options(recipe, args, turn: int, seed: int, out: Path) -> list[str]:
    given = ["--labels", args.labels, "--out", out, "--target", args.target, "--statuses", args.statuses, "--turn", turn,
             "--seed", seed, "--device", "cpu"]  # fmt: skip
    given += ["--sizes", args.sizes] if args.sizes is not None else []
    return [str(word) for word in given] + recipes.flags(recipe.options)


def inputs_of(args, rows, size: int) -> Path:
    """Crops cut at the very size, as the service cuts them, where they are there."""
    exact = args.inputs.with_name(f"{args.inputs.name}-{size}")
    if not (exact / "index.csv").is_file():
        return args.inputs
    if labels.read(args.labels, exact, args.statuses.split(","), args.target, args.sizes) != rows:
        raise SystemExit(f"{exact} does not hold the crops of the same rows as {args.inputs}")
    return exact


def of_network_recipe(recipe, args, rows, folder: Path) -> dict:
    validation, constant, held_out, seconds = [], [], [], []
    for turn, (train_rows, validation_rows, test_rows) in turns(args, rows):
        weights = pretrained(recipe, args, turn) if recipe.pretraining else None
        answers = []
        for seed in range(args.seeds):
            out = folder / f"turn-{turn}-seed-{seed}"
            out.mkdir(parents=True, exist_ok=True)
            given = train_options(recipe, args, turn, seed, out)
            given += ["--encoder-weights", str(weights)] if weights else []
            size = train_arguments([*given, "--inputs", str(args.inputs)]).size
            inputs = inputs_of(args, rows, size)
            with clock(out / "cpu_s"):
                train(train_arguments([*given, "--inputs", str(inputs)]))
            network = load_best(out)
            best = torch.load(out / "best.pt", map_location="cpu", weights_only=True)["validation_l1"]
            validation.append(best)
            photos = Photos(inputs, test_rows, size)
            with torch.no_grad():
                answers.append([float(network(photos.get(row, 0)[None, :INITIAL_IMAGES]).mean()) for row in test_rows])
            own = float((out / "cpu_s").read_text())
            seconds.append(own + (float((weights.parent / "cpu_s").read_text()) if weights else 0.0))
        constant.append(metrics.l1(median_of(train_rows), [row.views for row in validation_rows]))
        errors = np.abs(np.array(answers) - [row.views for row in test_rows]).mean(0)
        held_out += [(row.group, float(error)) for row, error in zip(test_rows, errors)]
    return {
        "parameters": sum(parameter.numel() for parameter in network.parameters()),
        "validation_l1": float(np.mean(validation)),
        "validation_constant_l1": float(np.mean(constant)),
        **with_interval(held_out),
        "train_cpu_s": float(np.mean(seconds)),
        **of_network(network),
    }


def turns(args, rows) -> list:
    """(turn, (train, validation, test)), of turns that have rows in each part."""
    parts = [(turn, split(rows, turn)) for turn in range(args.turns)]
    full = [(turn, each) for turn, each in parts if all(each)]
    if not full:
        raise SystemExit(f"{len(rows)} rows are too few to train on some, choose by some and hold some out")
    return full


def median_of(rows) -> float:
    return float(np.median([row.views for row in rows]))


def of_simple_recipe(kind: str, args, rows) -> dict:
    """The training median, or the ridge on image statistics: on the clean crops, fitted on training rows alone."""
    validation, constant, held_out = [], [], []
    begin = time.process_time()
    by_id = {row.id: line for row, line in zip(rows, baseline.features(args.inputs, rows))} if kind == "statistics" else {}
    for _, (train_rows, validation_rows, test_rows) in turns(args, rows):

        def answers(known, part):
            if kind == "constant":
                return np.full(len(part), median_of(known))
            x, y = np.array([by_id[row.id] for row in known]), np.array([row.views for row in known])
            return baseline.fit_predict(x, y, [row.group for row in known], np.array([by_id[row.id] for row in part]))

        truth = [row.views for row in validation_rows]
        validation.append(metrics.l1(answers(train_rows, validation_rows), truth))
        constant.append(metrics.l1(median_of(train_rows), truth))
        errors = np.abs(answers(train_rows + validation_rows, test_rows) - [row.views for row in test_rows])
        held_out += [(row.group, float(error)) for row, error in zip(test_rows, errors)]
    return {
        "parameters": 1 if kind == "constant" else 1 + len(next(iter(by_id.values()))),
        "validation_l1": float(np.mean(validation)),
        "validation_constant_l1": float(np.mean(constant)),
        **with_interval(held_out),
        "train_cpu_s": time.process_time() - begin,
    }


def with_interval(held_out) -> dict:
    groups, errors = [group for group, _ in held_out], [error for _, error in held_out]
    low, high = metrics.bootstrap(errors, groups)
    return {"held_out_l1": float(np.mean(errors)), "held_out_low": low, "held_out_high": high, "held_out_rows": len(errors)}


def of_recipe(recipe, args, rows) -> dict:
    """The recipe's figures, from its result.json if that is of the same recipe and rows."""
    folder = args.out / "runs" / recipes.folder_of(recipe.name)
    folder.mkdir(parents=True, exist_ok=True)
    asked = {"recipe": asdict(recipe), "seeds": args.seeds, "turns": args.turns, "target": args.target,
             "rows": [[row.id, row.views] for row in rows]}  # fmt: skip
    kept = folder / RESULT
    if kept.is_file():
        known = json.loads(kept.read_text())
        if known["asked"] == asked:
            result = known["result"]
            if args.latency_again and recipe.kind == "network":
                result.update(of_network(load_best(next(folder.glob("turn-*-seed-0")))))
                write(kept, json.dumps({"asked": asked, "result": result}))
            return result
    print(f"== {recipe.name}", flush=True)
    if recipe.kind == "network":
        result = of_network_recipe(recipe, args, rows, folder)
    else:
        result = of_simple_recipe(recipe.kind, args, rows)
    write(kept, json.dumps({"asked": asked, "result": result}))
    return result


def best_of(results: dict, latency_ms: float) -> str | None:
    """The name of the network of least validation L1 that answers in time, on two threads here or on one undisturbed."""
    networks = {name: r for name, r in results.items() if "latency_2_threads_ms" in r}
    in_time = {name: r for name, r in networks.items() if min(r["latency_2_threads_ms"], r["cpu_1_thread_ms"]) <= latency_ms}
    return min(in_time, key=lambda name: in_time[name]["validation_l1"], default=None)


def markdown(results: dict, best: str | None, args) -> str:
    rows = max(result["held_out_rows"] for result in results.values())
    lines = [
        f"Target {args.target}; {args.seeds} seed(s), {args.turns} turn(s), {rows} rows held out. The choice (bold) is the "
        f"least validation L1 at no more than {args.latency_ms:.0f} ms for three images on two threads, or in CPU time on "
        "one, which other work on the machine does not lengthen. What is solved (constant, statistics, ridge heads: every "
        "frozen encoder's but where small heads are named) is fitted to the validation rows too before it answers for held-out "
        "ones; what is trained in epochs chooses its epoch by them, which flatters its validation L1.",
        "",
        "| recipe | parameters | validation L1 | constant there | held-out L1 [95 % interval] | training, CPU s | "
        "three images, 1 / 2 threads (CPU, 1 thread) |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, r in results.items():
        mark = "**" if name == best else ""
        count = f"{r['parameters'] / 1e6:.1f} M" if r["parameters"] > 1e5 else str(r["parameters"])
        timing = ""
        if "cpu_1_thread_ms" in r:
            timing = f"{r['latency_1_thread_ms']:.0f} / {r['latency_2_threads_ms']:.0f} ({r['cpu_1_thread_ms']:.0f}) ms"
        lines.append(
            f"| {mark}{name}{mark} | {count} | {r['validation_l1']:.2f} | {r['validation_constant_l1']:.2f} | "
            f"{r['held_out_l1']:.2f} [{r['held_out_low']:.2f}, {r['held_out_high']:.2f}] | {r['train_cpu_s']:.0f} | {timing} |"
        )
    return "\n".join(lines) + "\n"


def write(path: Path, text: str):
    with whole(path) as partial:
        partial.write_text(text)


def main(argv=None):
    args = arguments(argv)
    rows = labels.read(args.labels, args.inputs, args.statuses.split(","), args.target, args.sizes)
    args.out.mkdir(parents=True, exist_ok=True)
    results = {}
    for recipe in recipes.chosen(recipes.read(args.recipes), args.slow, args.only):
        results[recipe.name] = of_recipe(recipe, args, rows)
        # After each recipe, so that there is something to read while the rest is running.
        with open(args.out / "compare.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            for name, result in results.items():
                figures = {key: f"{value:.4f}" if isinstance(value, float) else value for key, value in result.items()}
                writer.writerow({"recipe": name, **figures})
        write(args.out / "compare.md", markdown(results, best_of(results, args.latency_ms), args))
    print((args.out / "compare.md").read_text())


if __name__ == "__main__":
    main()
