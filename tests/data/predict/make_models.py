"""Makes the small ONNX files of this folder, stand-ins for PRVNet in the Rust tests.

    models/training/.venv/bin/python tests/data/predict/make_models.py

Each is the network's last step on the images' mean colours: with m and v the mean and the unbiased
variance over the images of each channel's mean, the answer is
low + (high - low) * sigmoid(4 * (sum(m) - 1.5) + 8 * sum(v)). The novelty is twice the darkness, 2 - 2 sum(m) / 3.
"""

from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

SIDE = 32
METADATA = {
    "format": "2",
    "input_size": str(SIDE),
    "label_min": "10",
    "label_max": "50",
    "encoder": "mean colour",
    "trained_on": "1",
    "held_out_l1": "9.5",
    "best_constant_l1": "10.25",
    "interval_level": "0.8",
    "interval_low": "-6.5",
    "interval_high": "9.25",
    "radius_min_m": "0.07",
    "radius_max_m": "0.12",
    "crop_half_size_m": "0.135",
}


def model(input_name="images", low=10.0, high=50.0, outputs=2):
    def constant(name, value, dtype=np.float32):
        return numpy_helper.from_array(np.array(value, dtype), name)

    nodes = [
        helper.make_node("ReduceMean", [input_name], ["colour"], axes=[2, 3], keepdims=0),
        helper.make_node("ReduceMean", ["colour"], ["mean"], axes=[0], keepdims=1),
        helper.make_node("Sub", ["colour", "mean"], ["difference"]),
        helper.make_node("ReduceSumSquare", ["difference"], ["squares"], axes=[0, 1], keepdims=0),
        helper.make_node("Shape", ["colour"], ["shape"]),
        helper.make_node("Gather", ["shape", "zero"], ["count"]),
        helper.make_node("Cast", ["count"], ["images_f"], to=TensorProto.FLOAT),
        helper.make_node("Sub", ["images_f", "one"], ["degrees"]),
        helper.make_node("Div", ["squares", "degrees"], ["variance"]),
        helper.make_node("Mul", ["variance", "eight"], ["from_variance"]),
        helper.make_node("ReduceSum", ["mean"], ["sum"], keepdims=0),
        helper.make_node("Sub", ["sum", "half_white"], ["centred"]),
        helper.make_node("Mul", ["centred", "four"], ["from_mean"]),
        helper.make_node("Add", ["from_mean", "from_variance"], ["logit"]),
        helper.make_node("Sigmoid", ["logit"], ["p"]),
        helper.make_node("Mul", ["p", "range"], ["scaled"]),
        helper.make_node("Add", ["scaled", "low"], ["view_count"]),
        helper.make_node("Mul", ["sum", "brightness"], ["bright"]),
        helper.make_node("Sub", ["two", "bright"], ["darkness"]),
        helper.make_node("Reshape", ["darkness", "vector"], ["novelty"]),
    ]
    graph = helper.make_graph(
        nodes,
        "tiny",
        [helper.make_tensor_value_info(input_name, TensorProto.FLOAT, ["n", 3, SIDE, SIDE])],
        [helper.make_tensor_value_info(name, TensorProto.FLOAT, [1]) for name in ("view_count", "novelty")[:outputs]],
        [
            constant("zero", [0], np.int64),
            constant("one", [1.0]),
            constant("eight", [8.0]),
            constant("four", [4.0]),
            constant("half_white", [1.5]),
            constant("range", [high - low]),
            constant("low", [low]),
            constant("two", [2.0]),
            constant("brightness", [2.0 / 3.0]),
            constant("vector", [1], np.int64),
        ],
    )
    result = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    onnx.checker.check_model(result)
    return result


def write(name, result, **changes):
    values = {**METADATA, **changes}
    helper.set_model_props(result, {f"prv.{key}": value for key, value in values.items() if value is not None})
    onnx.save(result, Path(__file__).parent / f"{name}.onnx")


write("tiny", model())
write("no_metadata", model(), input_size=None)
write("label_range_reversed", model(), label_max="9")
write("another_size", model(), input_size="64")
write("another_window", model(), crop_half_size_m="0.2")
write("another_input", model(input_name="pixels"))
write("old_format", model(outputs=1), format="1", interval_low=None, interval_high=None)
write("without_novelty", model(outputs=1))
write("interval_beside_the_answer", model(), interval_low="0.5")
write("answers_out_of_range", model(low=10.0, high=1000.0))
