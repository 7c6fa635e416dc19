r"""Fits the novelty of a model file again, on the features that the file itself gives; its view counts stay what they are.

    python -m prvnet.refit_novelty --model models/prvnet.onnx --golden models/prvnet.golden.json --labels models/labels.csv \
      --sizes 2 --inputs DIR

For a change of `novelty.py` no network has to be trained, nor its run to be at hand.
"""

import argparse
import hashlib
import io
import json
import warnings
from pathlib import Path

import onnx
import torch

from . import MAX_IMAGES, labels, novelty
from .export import NOVELTY_TOLERANCE, novelty_difference
from .files import whole
from .onnx_model import OnnxModel, twice_if_single
from .sources import Photos
from .splits import split

PREFIX = "/novelty/"


class Alone(torch.nn.Module):
    """The score by itself, named in its graph as in a model file's."""

    def __init__(self, fitted: novelty.Novelty):
        super().__init__()
        self.novelty = fitted

    def forward(self, features):
        return self.novelty(features)


class NoveltyGraph:
    """Where a model file that `prvnet.export` wrote keeps its novelty."""

    def __init__(self, proto: onnx.ModelProto):
        self.proto = proto
        own = [node for node in proto.graph.node if node.name.startswith(PREFIX)]
        # The exporter shares constants between the score and what is before it.
        made = {name for node in proto.graph.node if node.op_type == "Constant" or node.name.startswith(PREFIX) for name in node.output}
        constants = {each.name: each for each in proto.graph.initializer}
        features = {name for node in own for name in node.input} - made - {*constants, ""}
        if len(features) != 1 or "novelty.middle" not in constants:
            raise SystemExit("the file's graph is not one of prvnet.export")
        self.features = features.pop()
        # How many of the features, from the first, count.
        self.early = constants["novelty.middle"].dims[0]

    def reader(self):
        """Photos [n, 3, S, S] to their features [n, D]; of a single one twice."""
        proto = onnx.ModelProto()
        proto.CopyFrom(self.proto)
        proto.graph.output.append(onnx.helper.make_tensor_value_info(self.features, onnx.TensorProto.FLOAT, None))
        session = OnnxModel(proto.SerializeToString(), threads=1).session
        return lambda photos: session.run([self.features], {"images": twice_if_single(photos)})[0][: len(photos)]

    def replace(self, fitted: novelty.Novelty):
        """Takes the score's nodes out and puts those of `fitted` in."""
        buffer = io.BytesIO()
        with warnings.catch_warnings():
            # As for the whole file.
            warnings.simplefilter("ignore")
            torch.onnx.export(
                Alone(fitted).eval(), (torch.rand(3, self.early + 1),), buffer, dynamo=False, opset_version=17,
                input_names=[self.features], output_names=["novelty"], dynamic_axes={self.features: {0: "n"}},
            )  # fmt: skip
        new, graph = onnx.load_from_string(buffer.getvalue()).graph, self.proto.graph
        kept = [node for node in graph.node if not node.name.startswith(PREFIX)]
        read = {name for node in kept for name in node.input} | {self.features}
        kept = [node for node in kept if node.op_type != "Constant" or read & {*node.output}]
        taken = {name for node in kept for name in (*node.input, *node.output)}
        renamed = {}
        for name in [each.name for each in new.initializer] + [name for node in new.node for name in node.output]:
            if name in taken and name not in (self.features, "novelty"):
                renamed[name] = PREFIX + name
        for node in new.node:
            node.name = node.name if node.name.startswith(PREFIX) else PREFIX + node.name.lstrip("/")
            node.input[:] = [renamed.get(name, name) for name in node.input]
            node.output[:] = [renamed.get(name, name) for name in node.output]
        for each in new.initializer:
            each.name = renamed.get(each.name, each.name)
        constants = [each for each in graph.initializer if each.name in taken]
        del graph.node[:], graph.initializer[:]
        graph.node.extend([*kept, *new.node])
        graph.initializer.extend([*constants, *new.initializer])


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
    features = graph.reader()
    fitted = novelty.fit_to_shoots(lambda photos: features(photos)[:, : graph.early], args.inputs, known, size).eval()
    graph.replace(fitted)
    onnx.checker.check_model(graph.proto)

    written = graph.proto.SerializeToString()
    after, worst = OnnxModel(written), 0.0
    for k, row in enumerate(test[:40]):
        photos = Photos(args.inputs, [row], size).get(row, k % 2).numpy()[: 1 + k % MAX_IMAGES]
        count, score = after.answer(photos)
        if count != before.answer(photos)[0]:
            raise SystemExit("the view count has changed")
        worst = max(worst, novelty_difference(float(fitted(torch.from_numpy(features(twice_if_single(photos))))[0]), score))
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
