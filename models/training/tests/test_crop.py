"""The way from a photo to the network's input, as the service goes it: NumPy only."""

import numpy as np
import pytest

from prvnet import CROP_HALF_SIZE_M
from prvnet.crop import Camera, crop

D435 = Camera(915.607, 913.327, 647.145, 372.515)
LENS = Camera(610.0, 612.0, 322.0, 238.0, 0.1, -0.2, 0.001, -0.0005, 0.05)


def ball(camera: Camera, distance_m: float, radius_m: float, width: int, height: int) -> np.ndarray:
    """A disc that faces the camera at the object's centre, red to the right and green below of it, opaque."""
    fine_u = np.linspace(-1.2, 1.2, 4001)
    u, _ = camera.project(fine_u, np.zeros_like(fine_u))
    _, v = camera.project(np.zeros_like(fine_u), fine_u)
    known = ~np.isnan(u) & ~np.isnan(v)
    x = np.interp(np.arange(width) + 0.5, u[known], fine_u[known]) * distance_m
    y = np.interp(np.arange(height) + 0.5, v[known], fine_u[known]) * distance_m
    photo = np.zeros((height, width, 4), np.uint8)
    photo[..., 0] = np.where(x > 0, 255, 0)
    photo[..., 1] = np.where(y > 0, 255, 0)[:, None]
    photo[..., 3] = np.where(x[None] ** 2 + y[:, None] ** 2 < radius_m**2, 255, 0)
    return photo


@pytest.mark.parametrize(("camera", "width", "height", "size"), [(D435, 1280, 720, 224), (D435, 1280, 720, 48), (LENS, 640, 480, 128)])
@pytest.mark.parametrize("distance_m", [0.3, 0.45])
def test_an_object_has_its_true_size_whatever_camera_and_distance(camera, width, height, size, distance_m):
    radius_m = 0.09
    image = crop(ball(camera, distance_m, radius_m, width, height), camera, distance_m, size)
    side_m = 2 * CROP_HALF_SIZE_M
    area_m2 = (image[..., 3] / 255).sum() * (side_m / size) ** 2
    assert abs(area_m2 - np.pi * radius_m**2) < 0.02 * area_m2
    inside = image[..., 3] == 255
    assert image[:, size // 2 + 2 :, 0][inside[:, size // 2 + 2 :]].min() == 255
    assert image[: size // 2 - 2, :, 1][inside[: size // 2 - 2]].max() == 0


def test_fine_texture_becomes_its_mean():
    photo = np.full((720, 1280, 4), 255, np.uint8)
    photo[::2, ::2, :3] = photo[1::2, 1::2, :3] = 0
    image = crop(photo, D435, 0.45, 64)
    assert abs(image[..., :3].astype(int) - 127).max() <= 2 and image[..., 3].min() == 255


def test_what_lies_outside_of_the_photo_is_transparent_and_colours_do_not_bleed():
    photo = np.zeros((240, 320, 4), np.uint8)
    photo[..., 0] = 255
    photo[:, :, 3] = 255
    image = crop(photo, Camera(1000.0, 1000.0, 160.0, 120.0), 0.3, 32)
    assert image[0, 0, 3] == 0 and image[16, 16, 3] == 255
    assert set(image[image[..., 3] > 0][:, 0]) == {255}
