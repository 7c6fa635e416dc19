r"""Fits the novelty of a model file again, on the features that the file itself gives; its view counts stay what they are.

    python -m prvnet.refit_novelty --model models/prvnet.onnx --golden models/prvnet.golden.json --labels models/labels.csv \
      --sizes 2 --inputs DIR

For a change of `novelty.py` no network has to be trained, nor its run to be at hand.
"""

import argparse
import hashlib
import json
from pathlib import Path

import numpy as np
import onnx
import torch
from onnx import numpy_helper
from tqdm import tqdm

from . import MAX_IMAGES, labels, novelty
from .calibrate import NOVELTY_SHOOTS
from .export import NOVELTY_TOLERANCE, novelty_difference
from .files import whole
from .onnx_model import OnnxModel, twice_if_single
from .sources import Photos
from .splits import split

BUFFERS = ("middle", "spread", "center", "deviation", "scale")


class NoveltyGraph:
    """Where a model file that `prvnet.export` wrote keeps its novelty."""

    def __init__(self, proto: onnx.ModelProto):
        self.proto = proto
        self.initializers = {each.name: each for each in proto.graph.initializer}
        nodes = [node for node in proto.graph.node if node.name.startswith("/novelty/")]
        # The components are written transposed, and for that under a name of the exporter's.
        products = [node.input[1] for node in nodes if node.op_type == "MatMul"]
        slices = [node.output[0] for node in nodes if node.op_type == "Slice"]
        missing = [name for name in BUFFERS if f"novelty.{name}" not in self.initializers]
        if missing or len(products) != 1 or len(slices) != 1:
            raise SystemExit("the file's graph is not one of prvnet.export")
        self.components, self.early = products[0], slices[0]

    def replace(self, fitted: novelty.Novelty):
        tables = {f"novelty.{name}": getattr(fitted, name).numpy() for name in BUFFERS}
        tables[self.components] = np.ascontiguousarray(fitted.components.numpy().T)
        for name, table in tables.items():
            self.initializers[name].CopyFrom(numpy_helper.from_array(table, name))

    def reader(self):
        """Photos [n, 3, S, S] to their early features [n, D]; of a single one twice."""
        proto = onnx.ModelProto()
        proto.CopyFrom(self.proto)
        proto.graph.output.append(onnx.helper.make_tensor_value_info(self.early, onnx.TensorProto.FLOAT, None))
        session = OnnxModel(proto.SerializeToString(), threads=1).session
        return lambda photos: session.run([self.early], {"images": twice_if_single(photos)})[0]


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--model", type=Path, required=True)
    parser.add_argument("--labels", type=Path, required=True)
    parser.add_argument("--inputs", type=Path, required=True)
    parser.add_argument("--statuses", default="ok,not_converged", help="as the network was trained")
    parser.add_argument("--sizes", type=int, help="as the network was trained")
    parser.add_argument("--golden", type=Path, help="file of `prvnet.parity --golden`, which is to name the new file")
    args = parser.parse_args(argv)
    read = args.model.read_bytes()
    cases = json.loads(args.golden.read_text()) if args.golden else None
    if cases and cases["model_sha256"] != hashlib.sha256(read).hexdigest():
        raise SystemExit(f"{args.golden} is not of {args.model}")
    before = OnnxModel(read)
    turn, size = int(before.metadata["prv.turn"]), int(before.metadata["prv.input_size"])
    train, validation, test = split(labels.read(args.labels, args.inputs, args.statuses.split(","), sizes=args.sizes), turn)
    known = train + validation
    if int(before.metadata["prv.held_out"]) != len(test):
        raise SystemExit(f"{args.model} holds out {before.metadata['prv.held_out']} labels, of these it would {len(test)}")
    graph = NoveltyGraph(onnx.load_from_string(read))
    early, table = graph.reader(), []
    for row in tqdm(known, "features"):
        photos = Photos(args.inputs, [row], size)
        table.append(np.stack([early(photos.get(row, variant).numpy()) for variant in range(NOVELTY_SHOOTS)]))
    fitted = novelty.fit(np.stack(table), [row.group for row in known]).eval()
    graph.replace(fitted)
    onnx.checker.check_model(graph.proto)

    written = graph.proto.SerializeToString()
    after, worst = OnnxModel(written), 0.0
    for k, row in enumerate(test[:40]):
        photos = Photos(args.inputs, [row], size).get(row, k % 2).numpy()[: 1 + k % MAX_IMAGES]
        count, score = after.answer(photos)
        if count != before.answer(photos)[0]:
            raise SystemExit("the view count has changed")
        worst = max(worst, novelty_difference(float(fitted(torch.from_numpy(early(photos)))[0]), score))
    print(f"ONNX Runtime and PyTorch differ by at most {worst:.1e} of the novelty")
    if not worst <= NOVELTY_TOLERANCE:
        raise SystemExit(f"that is more than {NOVELTY_TOLERANCE:.0e}")
    with whole(args.model) as partial:
        partial.write_bytes(written)
    if cases:
        # Their view counts are the network's, which is the same.
        cases["model_sha256"] = hashlib.sha256(written).hexdigest()
        args.golden.write_text(json.dumps(cases, indent=1) + "\n")


if __name__ == "__main__":
    main()
