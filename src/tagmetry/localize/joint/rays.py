"""Viewing rays of corners, and how pixels change with a ray's direction."""

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry.arrays import Array


def rays_and_jacobians(camera: Camera, pixels: Array) -> tuple[Array, Array]:
    """Return unit rays and d(pixel) / d(point) at distance one.

    Args:
        camera: Intrinsics.
        pixels: Shape (..., 2).

    Returns:
        Rays, shape (..., 3), NaN where the lens shows nothing, and derivatives, (..., 2, 3).
    """
    rays = camera.unproject(pixels)
    by_point, _ = camera.lens.jacobians(rays)
    return rays, by_point * np.array(camera.focal_px)[:, None]
