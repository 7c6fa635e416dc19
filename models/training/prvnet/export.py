"""Exports a run to the model file the service loads: with its interval and its novelty, checked against PyTorch.

    python -m prvnet.export --run runs/x --out models/prvnet.onnx
"""

import argparse
import io
import json
import time
import warnings
from pathlib import Path

import numpy as np
import onnx
import torch

from . import CROP_HALF_SIZE_M, FORMAT, INITIAL_IMAGES, MAX_IMAGES, calibrate, interval, labels, metrics
from .files import whole
from .model import Exported, twice_if_single
from .onnx_model import OnnxModel
from .runs import fitted, load_best
from .sources import Photos

TOLERANCE = 1e-4
# Of the novelty, relatively: it is a difference of two sums of squares.
NOVELTY_TOLERANCE = 1e-3


def to_onnx(network, novelty) -> onnx.ModelProto:
    size = network.config["size"]
    buffer = io.BytesIO()
    with warnings.catch_warnings():
        # The tracing exporter is the one that writes opset 17.
        warnings.simplefilter("ignore")
        torch.onnx.export(
            Exported(network, novelty).eval(),
            (torch.rand(3, 3, size, size),),
            buffer,
            dynamo=False,
            opset_version=17,
            input_names=["images"],
            output_names=["view_count", "novelty"],
            dynamic_axes={"images": {0: "n"}},
        )
    model = onnx.load_from_string(buffer.getvalue())
    # The tracer leaves the outputs' length open; each is one number.
    for output in model.graph.output:
        shape = output.type.tensor_type.shape
        del shape.dim[:]
        shape.dim.add().dim_value = 1
    network.eval()
    return model


def novelty_difference(reference: float, score: float) -> float:
    return abs(reference - score) / (1e-3 + reference)


def check(network, novelty, model: OnnxModel, image_sets) -> tuple[float, float]:
    """The largest differences between PyTorch and ONNX Runtime: in views, and of the novelty, relatively."""
    views, relative = 0.0, 0.0
    with torch.no_grad():
        for images in image_sets:
            count, score = model.answer(images.numpy())
            views = max(views, abs(float(network(images.unsqueeze(0)).mean(1)[0]) - count))
            reference = float(novelty(network.encoder(twice_if_single(images[None])[0]))[0])
            relative = max(relative, novelty_difference(reference, score))
    return views, relative


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--labels", type=Path, help="default: what the run was trained on")
    parser.add_argument("--inputs", type=Path, help="default: what the run was trained on")
    parser.add_argument("--bank", type=Path, help="folder for the frozen encoder's features (default: the run's)")
    parser.add_argument("--turns", type=int, default=calibrate.TURNS, help="networks trained for the interval")
    parser.add_argument("--sisters", type=Path, nargs="+",
        help="runs of the other turns, to take the interval from what each of them holds out instead")  # fmt: skip
    parser.add_argument("--threads", type=int, default=1, help="for training those; heads are too small to share")
    args = parser.parse_args(argv)
    torch.set_num_threads(args.threads)
    where = json.loads((args.run / "where.json").read_text())
    args.labels, args.inputs = args.labels or Path(where["labels"]), args.inputs or Path(where["inputs"])
    network = load_best(args.run)
    config = network.config
    labelled = labels.read(args.labels, args.inputs, config["statuses"].split(","), config["target"], config.get("sizes"))
    rows = {row.id: row for row in labelled}
    missing = [id for part in config["rows"].values() for id in part if id not in rows]
    if missing:
        raise SystemExit(f"{len(missing)} rows of the run are not in {args.labels} and {args.inputs}")
    test = [rows[id] for id in config["rows"]["test"]]
    train = [rows[id] for id in config["rows"]["train"]]
    if not test:
        raise SystemExit("no rows are held out: there is no error to state in the model file")

    validation = [rows[id] for id in config["rows"]["validation"]]
    known = train + validation
    bank = args.bank or Path(where.get("bank", args.inputs / ".features"))
    begin = time.process_time()
    if args.sisters:
        residuals = calibrate.sisters_residuals(args.sisters, config, args.inputs, known)
    else:
        source = calibrate.source_of(args.run, config, args.inputs, bank, known)
        features = calibrate.features_of(args.run, config, args.inputs, bank, known) if config["head"] == "ridge" else None
        residuals = calibrate.residuals(args.run, config, source, features, known, args.turns)
    low, high = interval.offsets(residuals)
    print(f"{len(known)} objects' rows left out in turn: L1 {np.abs(residuals).mean():.2f} views, "
          f"{100 * interval.LEVEL:.0f} % interval {low:+.1f} to {high:+.1f}")  # fmt: skip
    novelty = calibrate.novelty_of(network, args.inputs, known).eval()
    print(f"calibrated in {time.process_time() - begin:.0f} CPU seconds")

    proto = to_onnx(network, novelty)
    model = OnnxModel(proto.SerializeToString())
    generator = torch.Generator().manual_seed(0)
    size = config["size"]
    random_sets = [torch.rand(n, 3, size, size, generator=generator) for n in (1, 2, 3, 4, 5) for _ in range(4)]
    photos = Photos(args.inputs, test, size)
    real_sets = [photos.get(row, v)[: 1 + (i + v) % MAX_IMAGES] for i, row in enumerate(test[:40]) for v in (0, 1)]
    for name, sets in (("random", random_sets), ("real", real_sets)):
        views, relative = check(network, novelty, model, sets)
        print(f"ONNX Runtime and PyTorch differ by at most {views:.1e} views, {relative:.1e} of the novelty, on "
              f"{len(sets)} {name} inputs")  # fmt: skip
        if not (views <= TOLERANCE and relative <= NOVELTY_TOLERANCE):
            raise SystemExit(f"that is more than {TOLERANCE:.0e} or {NOVELTY_TOLERANCE:.0e}")

    truth = [row.views for row in test]
    predicted = [model.predict(photos.get(row, 0)[:INITIAL_IMAGES].numpy()) for row in test]
    # The constant that does best on the held-out objects themselves is the harder one to beat.
    constant = metrics.l1(np.median(truth), truth)
    metadata = {
        "format": FORMAT,
        "input_size": size,
        "label_min": config["range"][0],
        "label_max": config["range"][1],
        "encoder": config["encoder"],
        "trained_on": config["trained_on"],
        "turn": config["turn"],
        "held_out": len(test),
        "held_out_l1": round(metrics.l1(predicted, truth), 4),
        "best_constant_l1": round(constant, 4),
        "training_median_l1": round(metrics.l1(np.median([row.views for row in fitted(config, train, validation)]), truth), 4),
        "interval_level": interval.LEVEL,
        "interval_low": round(low, 3),
        "interval_high": round(high, 3),
        "interval_objects": len({row.group for row in known}),
        "radius_min_m": min(row.radius_m for row in known),
        "radius_max_m": max(row.radius_m for row in known),
        "crop_half_size_m": CROP_HALF_SIZE_M,
    }
    onnx.helper.set_model_props(proto, {f"prv.{key}": str(value) for key, value in metadata.items()})
    onnx.checker.check_model(proto)
    args.out.parent.mkdir(parents=True, exist_ok=True)
    with whole(args.out) as partial:
        partial.write_bytes(proto.SerializeToString())
    print(f"{args.out}: {args.out.stat().st_size / 1e6:.1f} MB, held-out L1 {metadata['held_out_l1']:.2f} views on "
          f"{len(test)} objects, best constant {constant:.2f}")  # fmt: skip


if __name__ == "__main__":
    main()
