"""What a lab does to a photo: backgrounds, light, camera.

Everything random about one shoot of an object (background, light, lens blur) is drawn once and shared by its
photos; what differs from photo to photo (placement, exposure, noise) is drawn for each. NumPy and Pillow only.
"""

import io

import numpy as np
from PIL import Image, ImageFilter


def on_white(crop: np.ndarray) -> np.ndarray:
    """A straight-alpha crop [S, S, 4] of bytes on white, [S, S, 3] float32 in 0..1: the service's own input."""
    color, alpha = crop[..., :3].astype(np.float32), crop[..., 3:].astype(np.float32)
    return (color * alpha + 255.0 * (255.0 - alpha)) / (255.0 * 255.0)


def shoot(crops: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Random photos of one shoot: crops [n, S, S, 4] of bytes to [n, S, S, 3] float32 in 0..1."""
    side = crops.shape[1]
    scene = Scene(rng)
    return np.stack([photo(crop, scene.background(side, rng), scene, rng) for crop in crops])


class Scene:
    """What stays the same between the photos of one shoot."""

    def __init__(self, rng: np.random.Generator):
        # White is what renders, turntables and masked photos have; it is half of the world.
        self.kind = "white" if rng.random() < 0.5 else rng.choice(["solid", "gradient", "noise", "table"])
        self.colors = rng.random((3, 3)).astype(np.float32)
        self.gain = np.float32(np.exp(rng.normal(0, 0.15)))
        self.tint = np.exp(rng.normal(0, 0.05, 3)).astype(np.float32)
        self.gamma = np.float32(np.exp(rng.normal(0, 0.12)))
        self.saturation = np.float32(np.exp(rng.normal(0, 0.2)))
        self.blur = max(0.0, rng.normal(-0.2, 0.5))
        self.noise = abs(rng.normal(0, 0.012))

    def background(self, side: int, rng: np.random.Generator) -> np.ndarray:
        first, second, third = self.colors
        ramp = np.linspace(0, 1, side, dtype=np.float32)
        if self.kind == "solid":
            return np.broadcast_to(first, (side, side, 3)).copy()
        if self.kind == "gradient":
            angle = rng.uniform(0, 2 * np.pi)
            t = 0.5 + 0.5 * (np.cos(angle) * (ramp[None] - 0.5) + np.sin(angle) * (ramp[:, None] - 0.5))
            return first + (second - first) * t[..., None].astype(np.float32)
        if self.kind == "noise":
            return first + (second - first) * _smooth_noise(side, rng)[..., None]
        if self.kind == "table":
            grain = 0.25 * (_smooth_noise(side, rng, stretch=rng.uniform(1, 8)) - 0.5)[..., None]
            horizon = int(side * rng.uniform(-0.3, 0.6))
            wall = np.arange(side)[:, None, None] < horizon
            return np.clip(np.where(wall, second, third + grain), 0, 1).astype(np.float32)
        return np.ones((side, side, 3), np.float32)


def _smooth_noise(side: int, rng: np.random.Generator, stretch: float = 1.0) -> np.ndarray:
    """Noise of several scales in 0..1, [side, side]; `stretch` makes it streaky along x."""
    total, weight = np.zeros((side, side), np.float32), 0.0
    for cells, amount in ((3, 1.0), (9, 0.6), (40, 0.35)):
        wide = max(2, int(cells / stretch))
        coarse = Image.fromarray(rng.random((cells, wide), dtype=np.float32))
        total += amount * np.asarray(coarse.resize((side, side), Image.Resampling.BICUBIC))
        weight += amount
    return np.clip(total / weight, 0, 1)


def photo(crop: np.ndarray, background: np.ndarray, scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """A crop [S, S, 4] of bytes before `background` [S, S, 3] in the scene's light and camera, [S, S, 3] float32 in 0..1."""
    crop = _move(crop, rng)
    alpha = crop[..., 3:].astype(np.float32) / 255
    image = crop[..., :3].astype(np.float32) / 255 * alpha + background * (1 - alpha)
    if scene.kind == "white":
        # A white background comes from a mask: light and exposure change the object alone.
        image = _light(image, scene, rng) * alpha + (1 - alpha)
    else:
        image = _light(image, scene, rng)
    if scene.blur > 0.3:
        picture = Image.fromarray((image * 255 + 0.5).astype(np.uint8))
        image = np.asarray(picture.filter(ImageFilter.GaussianBlur(scene.blur)), np.float32) / 255
    image = np.clip(image + rng.normal(0, scene.noise, image.shape).astype(np.float32), 0, 1)
    if rng.random() < 0.3:
        image = _jpeg(image, int(rng.integers(40, 95)))
    return image.astype(np.float32)


def _light(image: np.ndarray, scene: Scene, rng: np.random.Generator) -> np.ndarray:
    grey = image.mean(-1, keepdims=True)
    image = grey + (image - grey) * scene.saturation
    exposure = scene.gain * np.float32(np.exp(rng.normal(0, 0.05)))
    return np.clip(np.clip(image, 0, 1) ** scene.gamma * exposure * scene.tint, 0, 1)


def _move(crop: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A small error of the object's centre, the distance and the camera's roll; half of the photos have none."""
    if rng.random() < 0.5:
        return crop
    side = crop.shape[0]
    angle, scale = np.deg2rad(rng.normal(0, 4)), np.exp(rng.normal(0, 0.02))
    shift = rng.normal(0, 0.02 * side, 2)
    cos, sin, middle = np.cos(angle) / scale, np.sin(angle) / scale, side / 2
    matrix = (
        cos, sin, middle - cos * (middle + shift[0]) - sin * (middle + shift[1]),
        -sin, cos, middle + sin * (middle + shift[0]) - cos * (middle + shift[1]),
    )  # fmt: skip
    # Premultiplied, so that the colour under transparent pixels does not bleed in.
    image = Image.fromarray(crop).convert("RGBa")
    moved = image.transform((side, side), Image.Transform.AFFINE, matrix, Image.Resampling.BICUBIC)
    return np.asarray(moved.convert("RGBA"))


def _jpeg(image: np.ndarray, quality: int) -> np.ndarray:
    buffer = io.BytesIO()
    Image.fromarray((image * 255 + 0.5).astype(np.uint8)).save(buffer, "JPEG", quality=quality)
    return np.asarray(Image.open(buffer).convert("RGB"), np.float32) / 255
