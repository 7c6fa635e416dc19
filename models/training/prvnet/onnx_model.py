"""A model file in ONNX Runtime, fed as the service feeds it."""

from pathlib import Path

import numpy as np
import onnxruntime

from .interval import bounds


def twice_if_single(images: np.ndarray) -> np.ndarray:
    """What the file wants at least two of: float [n, 3, S, S]."""
    return (np.concatenate([images, images]) if len(images) == 1 else images).astype(np.float32)


class OnnxModel:
    def __init__(self, model, threads: int = 2):
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = threads
        source = str(model) if isinstance(model, Path) else model
        self.session = onnxruntime.InferenceSession(source, options, providers=["CPUExecutionProvider"])
        self.metadata = self.session.get_modelmeta().custom_metadata_map

    def answer(self, images: np.ndarray) -> tuple[float, float]:
        """View count and novelty of images [n, 3, S, S] in 0..1; a single one is fed twice."""
        count, novelty = self.session.run(["view_count", "novelty"], {"images": twice_if_single(images)})
        return float(count[0]), float(novelty[0])

    def predict(self, images: np.ndarray) -> float:
        """The view count alone."""
        return self.answer(images)[0]

    def interval(self, answer: float) -> tuple[int, int]:
        """The interval around an answer, as the service states it."""
        return bounds(answer, *(float(self.metadata[f"prv.interval_{end}"]) for end in ("low", "high")))
