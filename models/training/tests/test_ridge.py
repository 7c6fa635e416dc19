"""The solved head finds what is there, and leaves out what is not."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch

sys.path.insert(0, str(Path(__file__).parent))
import synthetic
from prvnet import labels, model, ridge


class Features:
    """Stands in for a bank: one feature tells the label, the others are of the object or of the shoot alone."""

    def __init__(self, rows, dim, photos=5):
        rng, self.dim = np.random.default_rng(0), dim
        self.of = {row.id: rng.normal(size=dim) for row in rows}
        self.noise = rng.normal(size=(len(rows), 8, photos, dim)) * np.linspace(0, 2, dim)
        self.number = {row.id: k for k, row in enumerate(rows)}
        for row in rows:
            self.of[row.id][0] = (row.views - 24) / 3

    def batch(self, items):
        each = [self.of[row.id] + self.noise[self.number[row.id], variant % 8][images] for row, variant, images in items]
        return torch.from_numpy(np.stack(each).astype(np.float32))


def rows_of(count):
    rng = np.random.default_rng(1)
    return [labels.Row(str(k), f"object-{k}", f"object-{k}", 0.1, float(rng.normal(24, 3)), 1.0) for k in range(count)]


def answers(source, known, unseen):
    network = model.PRVNet({**synthetic.CONFIG, "head": "ridge", "heads": 1, "range": [-100, 100]})
    network.heads[0] = model.RidgeHead(2 * source.dim)
    ridge.fit(network, source, known, {"variants": 4, "seed": 0, "images": "1-5"})
    with torch.no_grad():
        return network(torch.cat([source.batch([(row, 0, [0, 1, 2])]) for row in unseen]))[:, 0].numpy()


def test_it_predicts_objects_it_has_not_seen_and_follows_no_noise():
    rows = rows_of(400)
    truth = np.array([row.views for row in rows[300:]])
    errors = np.abs(answers(Features(rows, 40), rows[:300], rows[300:]) - truth)
    assert errors.mean() < 0.3 * np.abs(np.median(truth) - truth).mean()


def test_labels_that_nothing_tells_get_their_mean():
    rows = rows_of(200)
    shuffled = np.random.default_rng(2).permutation([row.views for row in rows])
    known = [replace(row, views=float(views)) for row, views in zip(rows, shuffled)]
    off = np.abs(answers(Features(rows, 2000), known[:150], known[150:]) - shuffled[:150].mean())
    assert off.mean() < 0.5 * shuffled.std()


def test_the_answer_stays_within_the_labels():
    network = model.PRVNet({**synthetic.CONFIG, "head": "ridge", "heads": 1}).eval()
    with torch.no_grad():
        network.heads[0].bias.fill_(500.0)
    assert float(network(torch.rand(1, 3, 3, 64, 64)).detach()) == synthetic.CONFIG["range"][1]
