"""Exports a run to the model file the service loads, checked against PyTorch.

    python -m prvnet.export --run runs/x --out models/prvnet.onnx
"""

import argparse
import io
import json
import warnings
from pathlib import Path

import numpy as np
import onnx
import torch

from . import CROP_HALF_SIZE_M, FORMAT, INITIAL_IMAGES, MAX_IMAGES, labels, metrics
from .model import Exported
from .onnx_model import OnnxModel
from .sources import Photos
from .train import load_best

TOLERANCE = 1e-4


def to_onnx(network) -> onnx.ModelProto:
    size = network.config["size"]
    buffer = io.BytesIO()
    with warnings.catch_warnings():
        # The tracing exporter is the one that writes opset 17.
        warnings.simplefilter("ignore")
        torch.onnx.export(
            Exported(network).eval(),
            (torch.rand(3, 3, size, size),),
            buffer,
            dynamo=False,
            opset_version=17,
            input_names=["images"],
            output_names=["view_count"],
            dynamic_axes={"images": {0: "n"}},
        )
    model = onnx.load_from_string(buffer.getvalue())
    # The tracer leaves the output's length open; it is one number.
    shape = model.graph.output[0].type.tensor_type.shape
    del shape.dim[:]
    shape.dim.add().dim_value = 1
    network.eval()
    return model


def check(network, model: OnnxModel, image_sets) -> float:
    """The largest difference in views between PyTorch and ONNX Runtime."""
    worst = 0.0
    with torch.no_grad():
        for images in image_sets:
            reference = float(network(images.unsqueeze(0)).mean(1)[0])
            worst = max(worst, abs(reference - model.predict(images.numpy())))
    return worst


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--run", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--labels", type=Path, help="default: what the run was trained on")
    parser.add_argument("--inputs", type=Path, help="default: what the run was trained on")
    args = parser.parse_args(argv)
    where = json.loads((args.run / "where.json").read_text())
    args.labels, args.inputs = args.labels or Path(where["labels"]), args.inputs or Path(where["inputs"])
    network = load_best(args.run)
    config = network.config
    rows = {row.id: row for row in labels.read(args.labels, args.inputs, config["statuses"].split(","), config.get("target", "v_star"))}
    missing = [id for part in config["rows"].values() for id in part if id not in rows]
    if missing:
        raise SystemExit(f"{len(missing)} rows of the run are not in {args.labels} and {args.inputs}")
    test = [rows[id] for id in config["rows"]["test"]]
    train = [rows[id] for id in config["rows"]["train"]]
    if not test:
        raise SystemExit("no rows are held out: there is no error to state in the model file")

    proto = to_onnx(network)
    model = OnnxModel(proto.SerializeToString())
    generator = torch.Generator().manual_seed(0)
    size = config["size"]
    random_sets = [torch.rand(n, 3, size, size, generator=generator) for n in (1, 2, 3, 4, 5) for _ in range(4)]
    photos = Photos(args.inputs, test, size)
    real_sets = [photos.get(row, v)[: 1 + (i + v) % MAX_IMAGES] for i, row in enumerate(test[:40]) for v in (0, 1)]
    for name, sets in (("random", random_sets), ("real", real_sets)):
        worst = check(network, model, sets)
        print(f"ONNX Runtime and PyTorch differ by at most {worst:.1e} views on {len(sets)} {name} inputs")
        if not worst <= TOLERANCE:
            raise SystemExit(f"that is more than {TOLERANCE:.0e}")

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
        "held_out": len(test),
        "held_out_l1": round(metrics.l1(predicted, truth), 4),
        "best_constant_l1": round(constant, 4),
        "training_median_l1": round(metrics.l1(np.median([row.views for row in train]), truth), 4),
        "crop_half_size_m": CROP_HALF_SIZE_M,
    }
    onnx.helper.set_model_props(proto, {f"prv.{key}": str(value) for key, value in metadata.items()})
    onnx.checker.check_model(proto)
    args.out.parent.mkdir(parents=True, exist_ok=True)
    partial = args.out.with_suffix(".part")
    partial.write_bytes(proto.SerializeToString())
    partial.rename(args.out)
    print(f"{args.out}: {args.out.stat().st_size / 1e6:.1f} MB, held-out L1 {metadata['held_out_l1']:.2f} views on "
          f"{len(test)} objects, best constant {constant:.2f}")  # fmt: skip


if __name__ == "__main__":
    main()
