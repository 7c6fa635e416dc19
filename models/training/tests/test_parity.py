"""PyTorch, ONNX Runtime and the way from photos between them."""

import sys
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

sys.path.insert(0, str(Path(__file__).parent))
import synthetic
from prvnet import export, model, parity
from prvnet.latency import graph_of
from prvnet.onnx_model import OnnxModel


@pytest.fixture(scope="module")
def network():
    torch.manual_seed(0)
    network = model.PRVNet(synthetic.CONFIG).eval()
    for head in network.heads:
        # An untrained head answers nearly the same to everything, which any other network would, too.
        torch.nn.init.normal_(head[-1].weight, std=3.0)
    return network


def test_onnx_runtime_answers_a_hundred_inputs_as_pytorch_does(network, tmp_path):
    synthetic.make(tmp_path, objects=12, size=64)
    differences = parity.compare_onnx(network, OnnxModel(graph_of(network), 1), tmp_path / "inputs", 100)
    assert len(differences) == 100 and np.abs(differences).max() <= export.TOLERANCE
    for head in network.heads:
        torch.nn.init.normal_(head[-1].weight, std=3.0)
    others = parity.compare_onnx(network, OnnxModel(graph_of(model.PRVNet(synthetic.CONFIG).eval()), 1), tmp_path / "inputs", 10)
    assert np.abs(others).max() > 100 * export.TOLERANCE


def test_a_wrong_camera_or_distance_would_show(network):
    (width, height), camera = parity.CAMERAS[1]
    photos = [parity.pattern(seed, width, height) for seed in range(3)]

    def answer(camera, distance_m):
        return parity.answer_of(network, parity.images_of(photos, camera, distance_m, synthetic.CONFIG["size"]))

    right = answer(camera, 0.35)
    assert abs(right - answer(camera, 0.352)) > 10 * export.TOLERANCE
    assert abs(right - answer(parity.Camera(camera.fx, camera.fy, camera.cx, camera.cy), 0.35)) > 10 * export.TOLERANCE


def test_golden_cases_say_all_that_their_answer_depends_on(network, tmp_path):
    (tmp_path / "model.onnx").write_bytes(b"model")
    first, second = (parity.golden(network, tmp_path / "model.onnx") for _ in range(2))
    assert first == second and len(first["cases"]) == parity.GOLDEN_CASES
    case = first["cases"][1]
    photos = [parity.pattern(seed, case["width"], case["height"]) for seed in case["seeds"]]
    camera = parity.Camera(*map(float, case["camera"].split(",")))
    images = parity.images_of(photos, camera, case["distance_m"], synthetic.CONFIG["size"])
    assert parity.answer_of(network, images) == case["view_count"]
    # Values by integers that any language has: [(3 + 0) * 7 + 5 * 9 + (7 * 9 >> 4)] mod 256 and so on.
    assert parity.pattern(0, 320, 240)[9, 7].tolist() == [69, 92, 116, 0] and parity.pattern(0, 320, 240)[120, 160, 3] == 255
