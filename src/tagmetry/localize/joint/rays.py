"""Viewing rays of corners, and how pixels change with a ray's direction.

The lens of most cameras is straightened by a compiled Newton's method with derivatives from
differences, since arrays of forty numbers spend their time on their way. What it does not settle,
and every other lens, is left to the camera's own.
"""

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry.arrays import Array
from tagmetry.localize.joint.small import kernel

_COEFFICIENTS = 14
_TILTS = slice(12, 14)
_STEPS = 30
_SETTLED = 1e-13
_STEP = 1e-6  # for derivatives by differences


def rays_and_jacobians(camera: Camera, pixels: Array) -> tuple[Array, Array]:
    """Return unit rays and d(pixel) / d(point) at distance one.

    Args:
        camera: Intrinsics.
        pixels: Shape (n, 4, 2).

    Returns:
        Rays, shape (n, 4, 3), NaN where the lens shows nothing, and derivatives, (n, 4, 2, 3).
    """
    coefficients = np.zeros(_COEFFICIENTS)
    coefficients[: len(camera.lens.coefficients)] = camera.lens.coefficients
    if camera.lens.kind == "brown" and not coefficients[_TILTS].any():
        focal_px, center_px = np.array(camera.focal_px), np.array(camera.center_px)
        limit = min(np.tan(camera.lens.fold_angle_rad), 1e3)
        rays, by_point = _straightened(pixels, focal_px, center_px, coefficients, limit)
        if np.isfinite(rays).all():
            return rays, by_point
    rays = camera.unproject(pixels)
    by_point, _ = camera.lens.jacobians(rays)
    return rays, by_point * np.array(camera.focal_px)[:, None]


@kernel
def _straightened(
    pixels: Array, focal_px: Array, center_px: Array, k: Array, limit: float
) -> tuple[Array, Array]:
    """Return rays and derivatives of a lens without tilts; NaN for what does not settle."""
    count = len(pixels)
    rays, by_point = np.full((count, 4, 3), np.nan), np.zeros((count, 4, 2, 3))
    J = np.empty((2, 2))
    for n in range(count):
        for c in range(4):
            u = (pixels[n, c, 0] - center_px[0]) / focal_px[0]
            v = (pixels[n, c, 1] - center_px[1]) / focal_px[1]
            x, y, found = _found(u, v, k, limit, J)
            if not found:
                continue
            length = np.sqrt(x * x + y * y + 1.0)
            rays[n, c, 0], rays[n, c, 1], rays[n, c, 2] = x / length, y / length, 1.0 / length
            for i in range(2):
                a, b = focal_px[i] * length * J[i, 0], focal_px[i] * length * J[i, 1]
                by_point[n, c, i, 0], by_point[n, c, i, 1] = a, b
                by_point[n, c, i, 2] = -(a * x + b * y)
    return rays, by_point


@kernel
def _found(u: float, v: float, k: Array, limit: float, J: Array) -> tuple[float, float, bool]:
    """Return the ideal point that is bent to (u, v), and fill the derivative there."""
    x, y = u, v
    for _ in range(_STEPS):
        bent_u, bent_v = _bent(x, y, k)
        up, vp = _bent(x + _STEP, y, k)
        um, vm = _bent(x - _STEP, y, k)
        J[0, 0], J[1, 0] = (up - um) / (2 * _STEP), (vp - vm) / (2 * _STEP)
        up, vp = _bent(x, y + _STEP, k)
        um, vm = _bent(x, y - _STEP, k)
        J[0, 1], J[1, 1] = (up - um) / (2 * _STEP), (vp - vm) / (2 * _STEP)
        determinant = J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
        if not (determinant > 0.0 and np.sqrt(x * x + y * y) < 0.99 * limit):
            return x, y, False
        off_u, off_v = bent_u - u, bent_v - v
        if abs(off_u) + abs(off_v) < _SETTLED:
            return x, y, True
        x -= (J[1, 1] * off_u - J[0, 1] * off_v) / determinant
        y -= (J[0, 0] * off_v - J[1, 0] * off_u) / determinant
    return x, y, False


@kernel
def _bent(x: float, y: float, k: Array) -> tuple[float, float]:
    """Return the bent point: OpenCV's k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4."""
    r2 = x * x + y * y
    above = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))
    scale = above / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])))
    u = x * scale + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x) + r2 * (k[8] + r2 * k[9])
    v = y * scale + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y + r2 * (k[10] + r2 * k[11])
    return u, v
