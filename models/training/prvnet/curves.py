"""What else a labelled object's curve tells: numbers that a network can learn beside the view count, which is read off it.

The count is where the curve flattens; a network that also has to tell how good the object gets, and how much it gains on
the way there, is held to features of objects instead of the noise of one number.
"""

import numpy as np
import torch
from torch import nn

# Numbers of views whose gain up to the last one is learnt. With five views PSNR scatters by a dB from set to set.
FROM = (8, 12, 18, 27)
LAST = 100
TARGETS = 1 + len(FROM)


def targets(rows) -> np.ndarray:
    """[rows, TARGETS] decibels: PSNR at LAST views, and the rise to it from each of FROM."""
    table = np.empty((len(rows), TARGETS))
    for line, row in zip(table, rows):
        points = dict(row.curve)
        if not {*FROM, LAST} <= points.keys():
            raise SystemExit(f"{row.object}: its label has no PSNR of {LAST} and {FROM} views to learn; leave --curve-weight out")
        line[:] = [points[LAST], *(points[LAST] - points[count] for count in FROM)]
    return table


class CurveHead(nn.Linear):
    """Standardised features [B, 2 D] to `targets` in units of their spread over the objects trained on."""

    def __init__(self, dim):
        super().__init__(dim, TARGETS)
        self.register_buffer("middle", torch.zeros(TARGETS))
        self.register_buffer("spread", torch.ones(TARGETS))

    def scale_to(self, rows):
        table = targets(rows)
        self.middle.copy_(torch.from_numpy(table.mean(0)))
        self.spread.copy_(torch.from_numpy(table.std(0)))

    def standardised(self, rows) -> torch.Tensor:
        """What it should answer to `rows`: [rows, TARGETS]."""
        return (torch.from_numpy(targets(rows)).to(self.middle) - self.middle) / self.spread
