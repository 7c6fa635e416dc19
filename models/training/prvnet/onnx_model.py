"""A model file in ONNX Runtime, fed as the service feeds it."""

from pathlib import Path

import numpy as np
import onnxruntime


class OnnxModel:
    def __init__(self, model, threads: int = 2):
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = threads
        source = str(model) if isinstance(model, Path) else model
        self.session = onnxruntime.InferenceSession(source, options, providers=["CPUExecutionProvider"])
        self.metadata = self.session.get_modelmeta().custom_metadata_map

    def predict(self, images: np.ndarray) -> float:
        """Images [n, 3, S, S] in 0..1; a single one is fed twice."""
        if len(images) == 1:
            images = np.concatenate([images, images])
        return float(self.session.run(["view_count"], {"images": images.astype(np.float32)})[0][0])
