"""What `prv` does to a photo before the network sees it, written a second time to check it by. NumPy only.

The window is a square of 0.27 m at the object's centre, facing the camera, whose optical axis passes through the centre.
Each pixel of the crop is the mean of four bilinear samples of its own area, of the photo with premultiplied alpha, halved
until a sample stands for at most one of its pixels a side.
"""

import math
from dataclasses import astuple, dataclass

import numpy as np

from . import CROP_HALF_SIZE_M


@dataclass(frozen=True)
class Camera:
    """Intrinsics in pixels and OpenCV's distortion, in the order of `prv predict --camera`."""

    fx: float
    fy: float
    cx: float
    cy: float
    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0

    def flag(self) -> str:
        return ",".join(str(value) for value in astuple(self))

    def project(self, x, y):
        """Pixel coordinates of normalised ones, pixel centres at half-integers; NaN where the polynomial folds back."""
        r2 = x * x + y * y
        radial = 1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        u = x * radial + 2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x)
        v = y * radial + self.p1 * (r2 + 2 * y * y) + 2 * self.p2 * x * y
        folded = r2 > self._fold_radius() ** 2
        return np.where(folded, np.nan, self.fx * u + self.cx), np.where(folded, np.nan, self.fy * v + self.cy)

    def _fold_radius(self) -> float:
        if not any(astuple(self)[4:]):
            return math.inf
        radius = 0.0
        for step in range(1, 1001):
            r2 = (0.01 * step) ** 2
            if 1 + r2 * (3 * self.k1 + r2 * (5 * self.k2 + r2 * 7 * self.k3)) <= 0:
                break
            radius = 0.01 * step
        return radius


def crop(photo: np.ndarray, camera: Camera, distance_m: float, size: int) -> np.ndarray:
    """A photo [H, W, 4] of bytes, straight alpha, to the window's [size, size, 4]; what lies outside is transparent."""
    tan_half = CROP_HALF_SIZE_M / distance_m
    line = np.arange(size + 1) * (2 * tan_half / size) - tan_half
    u, v = camera.project(line[None, :], line[:, None])
    u, v = np.broadcast_to(u, (size + 1, size + 1)), np.broadcast_to(v, (size + 1, size + 1))
    if np.isnan(u).all():
        return np.zeros((size, size, 4), np.uint8)
    halvings = max(0, math.ceil(math.log2(max(camera.fx, camera.fy) * 2 * tan_half / size / 2)))
    pixels, origin = _region(photo, (np.nanmin(u), np.nanmin(v)), (np.nanmax(u), np.nanmax(v)), halvings)
    scale = 2.0**halvings
    total = np.zeros((size, size, 4), np.float32)
    for j in (0.25, 0.75):
        for i in (0.25, 0.75):
            x, y = (_between(_between(c[:-1, :-1], c[1:, :-1], j), _between(c[:-1, 1:], c[1:, 1:], j), i) for c in (u, v))
            total += _bilinear(pixels, (x - origin[0]) / scale - 0.5, (y - origin[1]) / scale - 0.5)
    total[np.isnan(x)] = 0
    alpha = total[..., 3:] / np.float32(4)
    color = total / np.where(total[..., 3:] > 0, total[..., 3:], 1) * np.float32(255)
    color[..., 3:] = alpha
    return np.where(alpha < 0.5, 0, np.clip(np.floor(color.astype(np.float64) + 0.5), 0, 255)).astype(np.uint8)


def _between(a, b, t):
    return a * (1 - t) + b * t


def _region(photo, low, high, halvings):
    """The part of the photo between two pixel coordinates, premultiplied and halved, and where its corner lies."""
    height, width = photo.shape[:2]
    margin = 2.0**halvings
    left, top = (int(min(max(math.floor(value) - margin, 0), end)) for value, end in zip(low, (width, height)))
    right, bottom = (int(min(max(math.ceil(value) + margin, 0), end)) for value, end in zip(high, (width, height)))
    part = photo[top:bottom, left:right].astype(np.float32)
    part[..., :3] *= part[..., 3:] / np.float32(255)
    for _ in range(halvings):
        part = np.pad(part, ((0, part.shape[0] % 2), (0, part.shape[1] % 2), (0, 0)))
        part = (part[::2, ::2] + part[::2, 1::2] + part[1::2, ::2] + part[1::2, 1::2]) / np.float32(4)
    return part, (left, top)


def _bilinear(pixels, x, y):
    """Samples at fractional indices; everything outside of the pixels is transparent."""
    height, width = pixels.shape[:2]
    padded = np.pad(pixels, ((1, 2), (1, 2), (0, 0)))
    inside = (x > -1) & (y > -1) & (x < width) & (y < height)
    x, y = np.where(inside, x, -1.0), np.where(inside, y, -1.0)
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    s, t = (x - left).astype(np.float32)[..., None], (y - top).astype(np.float32)[..., None]
    a, b, c, d = (padded[top + 1 + j, left + 1 + i] for j in (0, 1) for i in (0, 1))
    upper, lower = a + (b - a) * s, c + (d - c) * s
    return (upper + (lower - upper) * t) * inside[..., None].astype(np.float32)
