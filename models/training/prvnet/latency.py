"""How long ONNX Runtime takes for three images."""

import statistics
import time

import numpy as np
import torch

from . import INITIAL_IMAGES, MAX_IMAGES
from .export import to_onnx
from .novelty import COMPONENTS, Novelty, early_features
from .onnx_model import OnnxModel

RUNS = 20


def graph_of(network) -> bytes:
    """The service's graph, with a novelty that has the usual size and tells nothing."""
    dim = early_features(network.encoder)
    plain = {"middle": np.zeros(dim), "spread": np.ones(dim), "center": np.zeros(dim), "deviation": np.ones(dim),
             "components": np.zeros((min(COMPONENTS, dim), dim)), "scale": np.ones(MAX_IMAGES + 1)}  # fmt: skip
    with torch.no_grad():
        return to_onnx(network, Novelty(plain)).SerializeToString()


def of_network(network, threads=(1, 2)) -> dict[int, float]:
    """Threads to the median of twenty runs, ms."""
    graph = graph_of(network)
    size = network.config["size"]
    images = np.random.default_rng(0).random((INITIAL_IMAGES, 3, size, size), np.float32)
    result = {}
    for count in threads:
        model, times = OnnxModel(graph, count), []
        for _ in range(RUNS + 2):
            begin = time.perf_counter()
            model.predict(images)
            times.append(1e3 * (time.perf_counter() - begin))
        result[count] = statistics.median(times[2:])
    return result
