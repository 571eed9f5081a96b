"""Compiled rays are those of the camera model, and what they cannot do is left to it."""

import numpy as np
import pytest
from marked_world import DISTORTED, FISHEYE, VGA

from tagmetry.camera import BrownLens, Camera
from tagmetry.localize.joint.rays import rays_and_jacobians

CAMERAS = {
    "pinhole": VGA,
    "five": DISTORTED,
    "fisheye": FISHEYE,
    "eight": Camera(
        *(1280, 960, (900.0, 910.0), (640.0, 480.0)),
        BrownLens((0.3, -0.1, 0.002, -0.001, 0.02, 0.5, -0.05, 0.01)),
    ),
    "twelve": Camera(
        *(1280, 960, (900.0, 910.0), (640.0, 480.0)),
        BrownLens((-0.2, 0.1, 1e-3, -2e-3, 0.0, 0.0, 0.0, 0.0, 2e-3, -1e-3, 3e-3, 1e-3)),
    ),
    "tilted": Camera(
        *(1280, 960, (900.0, 910.0), (640.0, 480.0)),
        BrownLens((-0.2, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.02, -0.01)),
    ),
}


def some_pixels(camera):
    rng = np.random.default_rng(0)
    return rng.uniform(0, 1, (50, 4, 2)) * (np.array(camera.size_px) - 1)


@pytest.mark.parametrize("name", CAMERAS)
def test_they_are_those_of_the_camera(name):
    camera = CAMERAS[name]
    pixels = some_pixels(camera)
    rays, by_point = rays_and_jacobians(camera, pixels)
    np.testing.assert_allclose(rays, camera.unproject(pixels), atol=1e-10)
    back, expected = camera.project_with_jacobian(rays)
    np.testing.assert_allclose(back, pixels, atol=1e-7)
    np.testing.assert_allclose(by_point, expected, rtol=1e-6, atol=1e-4)


def test_pixels_that_no_ray_reaches_are_nan():
    camera = Camera(640, 480, (400.0, 400.0), (320.0, 240.0), BrownLens((-0.5, 0.0, 0.0, 0.0)))
    pixels = np.full((1, 4, 2), 250.0)
    pixels[0, 2] = 5000.0
    rays, _ = rays_and_jacobians(camera, pixels)
    assert np.isnan(rays[0, 2]).all()
    np.testing.assert_allclose(rays[0, :2], camera.unproject(pixels)[0, :2], atol=1e-12)
