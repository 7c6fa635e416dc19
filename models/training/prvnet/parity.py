"""Checks that PyTorch, ONNX Runtime and the service give the same number, the way from the photo included.

    python -m prvnet.parity --model ../prvnet.onnx --run runs/x --inputs DIR --count 100
    python -m prvnet.parity --model ../prvnet.onnx --run runs/x --prv ../../target/release/prv --photos DIR --count 100

The first compares ONNX Runtime with PyTorch on crops. The second lets `prv` photograph made objects, with several cameras
and distances, from one to five photos each, and compares what `prv predict` answers to the files with PyTorch's answer
to crops cut by `prvnet.crop`. Both end with status 1 where a number differs by more than 1e-4 views. `--golden FILE`
writes a few cases whose photos are made by a formula, with PyTorch's answers, for a test without PyTorch.
"""

import argparse
import hashlib
import json
import subprocess
from pathlib import Path

import numpy as np
import torch
from PIL import Image
from tqdm import tqdm

from . import MAX_IMAGES, labels
from .augment import on_white
from .crop import Camera, crop
from .export import TOLERANCE
from .onnx_model import OnnxModel
from .runs import load_best
from .sources import Photos, planes

# (width, height), intrinsics: a D435's colour camera, a webcam with distortion, a phone, a small one.
CAMERAS = (
    ((1280, 720), Camera(915.607, 913.327, 647.145, 372.515)),
    ((640, 480), Camera(612.0, 610.5, 322.4, 238.1, 0.1, -0.2, 0.001, -0.0005, 0.05)),
    ((1920, 1440), Camera(1500.0, 1502.0, 955.0, 731.0)),
    ((320, 240), Camera(290.0, 290.0, 160.0, 120.0)),
)
FAMILIES = ("animal", "basket", "bottle", "can", "carton", "lamp", "mug", "plant", "shoe", "tool", "vase", "vehicle")
GOLDEN_CASES = 8


def answer_of(network, images: torch.Tensor) -> float:
    """PyTorch's view count for [n, 3, S, S]."""
    with torch.no_grad():
        return float(network(images[None]).double().mean())


def compare_onnx(network, model: OnnxModel, inputs: Path, count: int) -> np.ndarray:
    """Differences in views on `count` sets of one to five photos: clean crops and random shoots in turn."""
    rows, size, differences = labels.photographed(inputs), network.config["size"], []
    for index in tqdm(range(count), "crops", leave=False):
        row, shoot = rows[index % len(rows)], index // len(rows) + index % 2
        images = Photos(inputs, [row], size).get(row, shoot)[: 1 + index % MAX_IMAGES]
        differences.append(model.predict(images.numpy()) - answer_of(network, images))
    return np.array(differences)


def photograph(prv: Path, folder: Path, index: int) -> tuple[list[Path], Camera, float]:
    """One to five photos of a made object by `prv capture`, those there already left alone; camera and distance, m."""
    (width, height), camera = CAMERAS[index % len(CAMERAS)]
    rng = np.random.default_rng(index)
    distance_m, radius_m = round(rng.uniform(0.3, 0.5), 4), round(rng.uniform(0.07, 0.12), 4)
    out = folder / f"{index:03}"
    if not (out / "transforms.json").is_file():
        command = [prv, "capture", "--object", f"made:{FAMILIES[index % len(FAMILIES)]}/{index}", "--views", "initial-five",
                   "--out", out, "--radius", radius_m, "--view-radius", distance_m, "--size", f"{width}x{height}",
                   "--camera", camera.flag()]  # fmt: skip
        run(command + (["--white"] if index % 3 == 0 else []))
    return sorted(out.glob("images/*.png"))[: 1 + index % MAX_IMAGES], camera, distance_m


def run(command) -> str:
    words = [str(word) for word in command]
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except OSError as error:
        raise SystemExit(f"{words[0]}: {error}") from None
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}: {done.stderr.strip()}")
    return done.stdout


def images_of(photos, camera: Camera, distance_m: float, size: int) -> torch.Tensor:
    """Photos [H, W, 4] of bytes as the network sees them, [n, 3, S, S] in 0..1."""
    return planes(np.stack([on_white(crop(photo, camera, distance_m, size)) for photo in photos]))


def compare_prv(network, prv: Path, model: Path, folder: Path, count: int) -> np.ndarray:
    differences = []
    for index in tqdm(range(count), "photos", leave=False):
        files, camera, distance_m = photograph(prv, folder, index)
        answer = json.loads(run([prv, "predict", *files, "--camera", camera.flag(), "--distance", distance_m,
                                 "--model", model, "--threads", 1, "--json"]))  # fmt: skip
        photos = [np.asarray(Image.open(file).convert("RGBA")) for file in files]
        images = images_of(photos, camera, distance_m, network.config["size"])
        differences.append(answer["raw"] - answer_of(network, images))
    return np.array(differences)


def pattern(seed: int, width: int, height: int) -> np.ndarray:
    """A photo [height, width, 4] of bytes by integers alone: stripes of three periods on a disc, clear elsewhere."""
    x, y = np.meshgrid(np.arange(width), np.arange(height))
    color = [((3 + seed + c) * x + (5 + 2 * c) * y + (x * y >> (4 + c))) & 255 for c in range(3)]
    inside = (2 * x + 1 - width) ** 2 + (2 * y + 1 - height) ** 2 < (height * (6 + seed % 3) // 9) ** 2
    return np.dstack([*color, np.where(inside, 255, 0)]).astype(np.uint8)


def golden(network, model: Path) -> dict:
    cases = []
    for index in range(GOLDEN_CASES):
        (width, height), camera = CAMERAS[index % len(CAMERAS)]
        seeds, distance_m = [7 * index + k for k in range(1 + index % MAX_IMAGES)], 0.3 + 0.02 * index
        images = images_of([pattern(seed, width, height) for seed in seeds], camera, distance_m, network.config["size"])
        cases.append({"width": width, "height": height, "camera": camera.flag(), "distance_m": distance_m, "seeds": seeds,
                      "view_count": answer_of(network, images)})  # fmt: skip
    return {"model_sha256": hashlib.sha256(model.read_bytes()).hexdigest(), "cases": cases}


def report(what: str, differences: np.ndarray) -> bool:
    largest = float(np.abs(differences).max())
    print(f"{what}: {len(differences)} inputs, differing by at most {largest:.1e} views, {np.abs(differences).mean():.1e} on average")
    return largest <= TOLERANCE


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--model", type=Path, required=True, help="model file of `prvnet.export`")
    add("--run", type=Path, required=True, help="the run it was exported from")
    add("--inputs", type=Path, help="folder of `prv inputs`")
    add("--prv", type=Path, help="the executable, to be compared too")
    add("--photos", type=Path, help="folder for its photos, kept; needed with --prv")
    add("--golden", type=Path, help="file to write cases to that need no photos")
    add("--count", type=int, default=100)
    args = parser.parse_args(argv)
    if not (args.inputs or args.prv or args.golden) or (args.prv and not args.photos):
        parser.error("give --inputs, --prv with --photos, or --golden")
    network, model = load_best(args.run), OnnxModel(args.model)
    if model.metadata["prv.input_size"] != str(network.config["size"]):
        raise SystemExit(f"{args.model} was not exported from {args.run}")
    agree = []
    if args.inputs:
        agree.append(report("ONNX Runtime and PyTorch", compare_onnx(network, model, args.inputs, args.count)))
    if args.prv:
        agree.append(report("prv and PyTorch", compare_prv(network, args.prv, args.model, args.photos, args.count)))
    if args.golden:
        args.golden.write_text(json.dumps(golden(network, args.model), indent=1) + "\n")
    if not all(agree):
        raise SystemExit(f"that is more than {TOLERANCE:.0e}")


if __name__ == "__main__":
    main()
