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
             "components": np.zeros((min(COMPONENTS, dim), dim)), "scale": np.ones(MAX_IMAGES + 1),
             "emptiness": np.zeros(dim), "offset": 0, "empty_scale": np.ones(MAX_IMAGES + 1)}  # fmt: skip
    with torch.no_grad():
        return to_onnx(network, Novelty(plain)).SerializeToString()


def of_network(network) -> dict[str, float]:
    """Medians of twenty runs, ms: on one and on two threads, and the CPU time of one.

    That CPU time is what a quiet machine would take on one thread at most, however busy this one is.
    """
    graph = graph_of(network)
    size = network.config["size"]
    images = np.random.default_rng(0).random((INITIAL_IMAGES, 3, size, size), np.float32)
    (one, cpu), (two, _) = (_medians(OnnxModel(graph, threads), images) for threads in (1, 2))
    return {"latency_1_thread_ms": one, "latency_2_threads_ms": two, "cpu_1_thread_ms": cpu}


def _medians(model: OnnxModel, images) -> tuple[float, float]:
    """Wall and CPU time, ms."""
    wall, cpu = [], []
    for _ in range(RUNS + 2):
        begin, cpu_begin = time.perf_counter(), time.process_time()
        model.predict(images)
        wall.append(1e3 * (time.perf_counter() - begin))
        cpu.append(1e3 * (time.process_time() - cpu_begin))
    return statistics.median(wall[2:]), statistics.median(cpu[2:])
