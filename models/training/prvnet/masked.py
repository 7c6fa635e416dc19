"""Masked pictures for a ConvNeXt-V2: the encoder sees some patches only, a light decoder paints the others.

FCMAE (Woo et al., ConvNeXt V2: Co-designing and Scaling ConvNets with Masked Autoencoders, CVPR 2023, section 3.1),
with the sparse convolutions computed densely: features of hidden patches are set to zero wherever they would arise.
Nothing can then reach a visible patch from a hidden one, as in a submanifold sparse convolution.
"""

import torch
from torch import nn

# Side of a patch, pixels: the encoder's whole stride, so that no feature straddles two patches.
PATCH = 32
# Added to a patch's variance, of values in 0..1: an empty background's sensor noise is not worth painting.
VARIANCE_FLOOR = 1e-3


def random_mask(count: int, size: int, ratio: float, generator=None) -> torch.Tensor:
    """[count, 1, size / 32, size / 32]; 1 where a patch is hidden, the same number of them in each picture."""
    side = size // PATCH
    hidden = min(max(round(ratio * side * side), 1), side * side - 1)
    order = torch.rand(count, side * side, generator=generator).argsort(1)
    mask = torch.zeros(count, side * side).scatter_(1, order[:, :hidden], 1.0)
    return mask.view(count, 1, side, side)


def patches(images: torch.Tensor) -> torch.Tensor:
    """[N, 3, S, S] to [N, 3 * 32 * 32, S / 32, S / 32]."""
    return nn.functional.pixel_unshuffle(images, PATCH)


def target_of(images: torch.Tensor) -> torch.Tensor:
    """Patches less their own mean, over their own deviation."""
    target = patches(images)
    variance, mean = torch.var_mean(target, 1, keepdim=True)
    return (target - mean) / (variance + VARIANCE_FLOOR).sqrt()


class SparseEncoder(nn.Module):
    """A timm ConvNeXt-V2 whose features of hidden patches are zero. The network given is the one that is trained."""

    def __init__(self, net: nn.Module):
        super().__init__()
        from timm.models.convnext import ConvNeXtBlock

        self.net, self.mask = net, None
        blocks = [module for module in net.modules() if isinstance(module, ConvNeXtBlock)]
        # Biases and normalisations lift zeros, and the depthwise convolutions carry features over borders. The
        # activation comes before the response normalisation, which looks at all places at once.
        inside = [part for block in blocks for part in (block.conv_dw, block.mlp.act, block)]
        for module in (net.stem, *(stage.downsample for stage in net.stages), *inside):
            module.register_forward_hook(self._hide)

    def _hide(self, _module, _inputs, features):
        if self.mask is None:
            return features
        times = features.shape[-1] // self.mask.shape[-1]
        visible = 1 - self.mask.repeat_interleave(times, 2).repeat_interleave(times, 3)
        return features * visible.to(features.dtype)

    def forward(self, images, mask):
        """Normalised images [N, 3, S, S] and a mask to [N, C, S / 32, S / 32]."""
        self.mask = mask
        try:
            x = self.net.stem(images)
            for stage in self.net.stages:
                x = stage(x)
        finally:
            self.mask = None
        return x


class Decoder(nn.Module):
    """One block that paints the hidden patches from the visible ones' features."""

    def __init__(self, dim: int, width: int):
        super().__init__()
        from timm.models.convnext import ConvNeXtBlock

        self.enter = nn.Conv2d(dim, width, 1)
        self.hidden = nn.Parameter(torch.zeros(1, width, 1, 1))
        nn.init.normal_(self.hidden, std=0.02)
        self.block = ConvNeXtBlock(width, conv_mlp=True, use_grn=True, ls_init_value=None)
        self.leave = nn.Conv2d(width, 3 * PATCH * PATCH, 1)

    def forward(self, features, mask):
        x = self.enter(features)
        return self.leave(self.block(x * (1 - mask) + self.hidden * mask))


class MaskedAutoencoder(nn.Module):
    """`encoder` is an `encoders.ConvNeXtV2`."""

    def __init__(self, encoder: nn.Module, width: int):
        super().__init__()
        self.encoder, self.sparse = encoder, SparseEncoder(encoder.net)
        self.decoder = Decoder(encoder.net.num_features, width)

    def forward(self, images, mask):
        """Images [N, 3, S, S] in 0..1 and a mask to the mean squared error on the hidden patches."""
        painted = self.decoder(self.sparse(self.encoder.normalise(images), mask), mask)
        error = (painted - target_of(images)).square().mean(1, keepdim=True)
        return (error * mask).sum() / mask.sum()
