"""A camera as a vector (fx, fy, cx, cy, coefficients), and where two cameras differ."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.camera.brown_lens import BrownLens
from tagmetry.camera.model import Camera
from tagmetry.geometry.arrays import Array

COLUMNS, ROWS = 17, 11


def parameters(camera: Camera) -> Array:
    """Return (fx, fy, cx, cy, coefficients), shape (4 + n,)."""
    return np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients])


def with_parameters(camera: Camera, values: Array) -> Camera:
    """Return the camera with other numbers and without a covariance."""
    fx, fy, cx, cy, *coefficients = (float(value) for value in values)
    lens = replace(camera.lens, coefficients=tuple(coefficients))  # type: ignore[type-var]
    return replace(camera, focal_px=(fx, fy), center_px=(cx, cy), lens=lens, covariance=None)


def alike(cameras: Sequence[Camera]) -> tuple[Camera, ...]:
    """Return the same cameras with equally many coefficients: those that were left out are zero."""
    count = max(len(camera.lens.coefficients) for camera in cameras)
    return tuple(_padded(camera, count) for camera in cameras)


def pixel_grid(camera: Camera) -> Array:
    """Return pixels that cover the image up to its corners, shape (n, 2)."""
    u = np.linspace(-0.5, camera.width_px - 0.5, COLUMNS)
    v = np.linspace(-0.5, camera.height_px - 0.5, ROWS)
    return np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)


def displacement_px(found: Camera, expected: Camera) -> Array:
    """Return where `found` shows the rays of `expected`, less where that one does, shape (n, 2).

    NaN where one of the two shows nothing.
    """
    pixels = pixel_grid(expected)
    return np.asarray(found.project(expected.unproject(pixels)) - pixels)


def worst_displacement_px(found: Camera, expected: Camera) -> float:
    """Return the largest displacement over the image; infinite where none can be compared."""
    distances = np.linalg.norm(displacement_px(found, expected), axis=-1)
    seen = distances[np.isfinite(distances)]
    return float(seen.max()) if seen.size else float("inf")


def mean_variance_px2(camera: Camera) -> float:
    """Return the mean over the image of what the covariance makes of a ray's pixel, both axes."""
    jacobian = camera.parameter_jacobian(camera.unproject(pixel_grid(camera)))
    jacobian = jacobian[np.isfinite(jacobian).all(axis=(1, 2))]
    carried = np.einsum("mij,jk,mik->m", jacobian, np.asarray(camera.covariance), jacobian)
    return float(carried.mean())


def _padded(camera: Camera, count: int) -> Camera:
    missing = count - len(camera.lens.coefficients)
    if missing == 0 or not isinstance(camera.lens, BrownLens):
        return camera
    lens = BrownLens(camera.lens.coefficients + (0.0,) * missing)
    covariance = camera.covariance
    if covariance is not None:
        covariance = np.pad(covariance, (0, missing))
    return replace(camera, lens=lens, covariance=covariance)
