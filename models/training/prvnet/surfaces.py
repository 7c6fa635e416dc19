"""Pictures of surfaces as they fill a photo: grain, stone, cloth, planks and tiles, drawn from noise.

Natural pictures have about as much contrast at every scale: noise whose amplitude falls with a power of the frequency
looks like stone, and like wood or cloth where it is stretched along one direction (Field, Journal of the Optical Society
of America A 4, 1987).
"""

import numpy as np

from . import augment


def shoot(crops: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """As `augment.shoot`, before surfaces: crops [n, S, S, 4] of bytes to [n, S, S, 3] float32 in 0..1."""
    scene = augment.Scene(rng)
    # Not a masked photo's, whose background the light leaves alone.
    scene.kind = "surface"
    return np.stack([augment.photo(crop, surface(crop.shape[0], rng), scene, rng) for crop in crops])


def surface(side: int, rng: np.random.Generator) -> np.ndarray:
    """[side, side, 3] float32 in 0..1."""
    low = rng.random(3)
    high = np.clip(low + rng.normal(0, 0.35) + rng.normal(0, 0.1, 3), 0, 1)
    pattern = _noise(side, rng)
    if rng.random() < 0.4:
        pattern = _in_pieces(pattern, rng)
    return (low + (high - low) * pattern[..., None]).astype(np.float32)


def _noise(side: int, rng: np.random.Generator) -> np.ndarray:
    """Noise of all scales in 0..1, [side, side], of random roughness, stretched along a random direction."""
    angle, stretch, roughness = rng.uniform(0, np.pi), np.exp(rng.uniform(0, 2.5)), rng.uniform(0.5, 2.0)
    x, y = np.fft.fftfreq(side)[None, :], np.fft.fftfreq(side)[:, None]
    along, across = np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x
    frequency = np.sqrt((along * stretch) ** 2 + across**2) + 0.5 / side
    spectrum = np.fft.fft2(rng.normal(size=(side, side))) * frequency**-roughness
    noise = np.fft.ifft2(spectrum).real
    low, high = np.quantile(noise, [0.01, 0.99])
    return np.clip((noise - low) / (high - low), 0, 1)


def _in_pieces(pattern: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """The same in planks or tiles, each of its own brightness, with dark joints."""
    side = len(pattern)
    across, along = rng.integers(8, side // 2), rng.integers(8, 2 * side)
    row = (np.arange(side)[:, None] + rng.integers(side)) // across
    column = (np.arange(side)[None, :] + 7 * row * rng.integers(0, 2)) // along
    shade = rng.normal(0, 0.12, (int(row.max()) + 1, int(column.max()) + 1))[row, column]
    joint = (np.diff(row, axis=0, prepend=row[:1]) != 0) | (np.diff(column, axis=1, prepend=column[:, :1]) != 0)
    pieces = np.clip(pattern + shade, 0, 1)
    pieces = pieces * np.where(joint, rng.uniform(0.2, 1), 1)
    return pieces.T if rng.random() < 0.5 else pieces
