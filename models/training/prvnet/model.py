"""PRVNet: a shared encoder, mean and variance over the images, a fully connected head (paper, section PRVNet)."""

import math

import torch
from torch import nn

from . import encoders


def mean_and_variance(features):
    """[B, n, D] to [B, 2 D]: mean and unbiased variance over the n >= 2 images."""
    mean = features.mean(1)
    difference = features - mean.unsqueeze(1)
    variance = (difference * difference).sum(1) / (features.shape[1] - 1)
    return torch.cat([mean, variance], 1)


def twice_if_single(images):
    """The variance over one image is undefined: a single one is fed twice, as in the authors' system."""
    return torch.cat([images, images], 1) if images.shape[1] == 1 else images


class PaperHead(nn.Sequential):
    """The authors' head: linear layers with nothing between them."""

    def __init__(self, dim):
        sizes = (dim, 1000, 500, 250, 100, 1)
        super().__init__(*(nn.Linear(a, b) for a, b in zip(sizes, sizes[1:])))


class SmallHead(nn.Sequential):
    """One hidden layer on standardised features, for some hundred objects instead of thousands."""

    def __init__(self, dim, hidden=64, dropout=0.5):
        super().__init__(
            nn.BatchNorm1d(dim, momentum=0.05),
            nn.Dropout(dropout),
            nn.Linear(dim, hidden),
            nn.GELU(),
            nn.Dropout(dropout),
            nn.Linear(hidden, 1),
        )


class RidgeHead(nn.Linear):
    """One linear layer on standardised features that answers in views; `ridge` solves it.

    A feature further than LIMIT spreads from its middle over the objects trained on counts as just that far: what is
    off the scale is no reason for an answer off the scale.
    """

    LIMIT = 5.0

    def __init__(self, dim):
        super().__init__(dim, 1)
        self.register_buffer("middle", torch.zeros(dim))
        self.register_buffer("spread", torch.ones(dim))

    def standardised(self, features):
        return ((features - self.middle) / self.spread).clamp(-self.LIMIT, self.LIMIT)

    def forward(self, features):
        return super().forward(self.standardised(features))


HEADS = {"paper": PaperHead, "small": SmallHead, "ridge": RidgeHead}


class PRVNet(nn.Module):
    """Images [B, n, 3, S, S] in 0..1, or their features [B, n, D], to view counts [B, heads].

    Several heads, trained side by side from different seeds, cost next to nothing; their mean is the answer.
    """

    def __init__(self, config: dict, pretrained=True):
        super().__init__()
        self.config = config
        self.encoder = encoders.make(config["encoder"], config["size"], config["levels"], pretrained)
        make_head = HEADS[config["head"]]
        self.heads = nn.ModuleList(make_head(2 * self.encoder.dim) for _ in range(config["heads"]))
        self.low, self.high = (float(bound) for bound in config["range"])

    def start_at(self, views: float):
        """Sets the heads' last bias so that training starts at the best constant."""
        p = min(max((views - self.low) / (self.high - self.low), 0.02), 0.98)
        for head in self.heads:
            nn.init.constant_(head[-1].bias, math.log(p / (1 - p)))

    def encode(self, images):
        """[B, n, 3, S, S] to [B, n, D]."""
        return self.encoder(images.flatten(0, 1)).unflatten(0, images.shape[:2])

    def forward(self, x):
        x = twice_if_single(x)
        features = mean_and_variance(self.encode(x) if x.ndim == 5 else x)
        return self.answers(features)

    def answers(self, features):
        """Means and variances [B, 2 D] to view counts [B, heads] within the range."""
        outputs = torch.cat([head(features) for head in self.heads], 1)
        if self.config["head"] == "ridge":
            return outputs.clamp(self.low, self.high)
        return self.low + (self.high - self.low) * torch.sigmoid(outputs)


class Exported(nn.Module):
    """The model file's graph: images [n, 3, S, S] with n >= 2 to one view count [1] and one novelty [1]."""

    def __init__(self, network: PRVNet, novelty: nn.Module):
        super().__init__()
        self.network = network
        self.novelty = novelty

    def forward(self, images):
        each = self.network.encoder(images)
        return self.network.answers(mean_and_variance(each.unsqueeze(0))).mean(1), self.novelty(each)
