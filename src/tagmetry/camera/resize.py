"""The same camera seen through a scaled, cropped, zoomed or turned image.

All keep the convention that an integer pixel is a pixel's centre, so scaling by s maps u to
s (u + 1/2) - 1/2. Covariances follow.
"""

from dataclasses import replace

import numpy as np

from tagmetry.camera.brown_lens import BrownLens
from tagmetry.camera.model import Camera
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array


def scaled(camera: Camera, width_px: int, height_px: int) -> Camera:
    """Return the camera of images that were resampled to another size."""
    if width_px < 1 or height_px < 1:
        raise InputError(f"image size must be positive, got {width_px}x{height_px}")
    sx, sy = width_px / camera.width_px, height_px / camera.height_px
    (fx, fy), (cx, cy) = camera.focal_px, camera.center_px
    return replace(
        camera,
        width_px=width_px,
        height_px=height_px,
        focal_px=(fx * sx, fy * sy),
        center_px=((cx + 0.5) * sx - 0.5, (cy + 0.5) * sy - 0.5),
        covariance=_carried(camera, np.diag([sx, sy, sx, sy])),
    )


def cropped(camera: Camera, left_px: int, top_px: int, width_px: int, height_px: int) -> Camera:
    """Return the camera of images that were cut out; the window may reach over the edge."""
    cx, cy = camera.center_px
    return replace(
        camera, width_px=width_px, height_px=height_px, center_px=(cx - left_px, cy - top_px)
    )


def zoomed(camera: Camera, factor: float) -> Camera:
    """Return the camera after a digital zoom: the middle 1/factor of the image, same size again."""
    if not (np.isfinite(factor) and factor >= 1):
        raise InputError(f"a digital zoom is at least 1, got {factor}")
    (fx, fy), (cx, cy) = camera.focal_px, camera.center_px
    middle_x, middle_y = (camera.width_px - 1) / 2, (camera.height_px - 1) / 2
    return replace(
        camera,
        focal_px=(fx * factor, fy * factor),
        center_px=(middle_x + factor * (cx - middle_x), middle_y + factor * (cy - middle_y)),
        covariance=_carried(camera, factor * np.eye(4)),
        zoom=camera.zoom * factor,
    )


def rotated(camera: Camera, quarters_clockwise: int) -> Camera:
    """Return the camera of images that were turned by quarters, as a ceiling mount may do."""
    for _ in range(quarters_clockwise % 4):
        camera = _turned_once(camera)
    return camera


def _turned_once(camera: Camera) -> Camera:
    """Turn by 90 degrees clockwise: (x, y) becomes (-y, x), (u, v) becomes (height - 1 - v, u)."""
    (fx, fy), (cx, cy) = camera.focal_px, camera.center_px
    intrinsics = np.array([[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]], dtype=float)
    coefficients = camera.lens.coefficients
    turn = np.eye(len(coefficients))
    lens = camera.lens
    if isinstance(lens, BrownLens):
        turn = _coefficient_turn(coefficients)
        lens = BrownLens(tuple(float(c) for c in turn @ np.array(coefficients)))
    return replace(
        camera,
        width_px=camera.height_px,
        height_px=camera.width_px,
        focal_px=(fy, fx),
        center_px=(camera.height_px - 1 - cy, cx),
        lens=lens,
        covariance=_carried(camera, intrinsics, turn),
    )


def _coefficient_turn(coefficients: tuple[float, ...]) -> Array:
    """Return the matrix that turns Brown coefficients.

    p1' = p2, p2' = -p1; s1' = -s3, s3' = s1; s2' = -s4, s4' = s2; tx' = -ty, ty' = tx.
    """
    if any(coefficients[12:]):
        raise InputError("a lens with a tilted sensor (14 coefficients) cannot be turned exactly")
    turn = np.eye(len(coefficients))
    swaps = [(2, 3, 1.0), (8, 10, -1.0), (9, 11, -1.0), (12, 13, -1.0)]
    for first, second, sign in swaps:
        if second < len(coefficients):
            turn[[first, second]] = sign * turn[second], -sign * turn[first]
    return turn


def _carried(camera: Camera, intrinsics: Array, coefficients: Array | None = None) -> Array | None:
    if camera.covariance is None:
        return None
    jacobian = np.eye(camera.parameter_count)
    jacobian[:4, :4] = intrinsics
    if coefficients is not None:
        jacobian[4:, 4:] = coefficients
    return np.asarray(jacobian @ camera.covariance @ jacobian.T)
