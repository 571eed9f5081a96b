"""Pixels as a camera without distortion would see them, around one marker.

Within a marker the lens's map is a polynomial of fifth degree to a ten-thousandth of a pixel; it is
taken from the camera once per marker, so that no pixel needs the lens's own, slower formula. The
straight image is the plane across the ray through the marker's middle (gnomonic), so that even a
fisheye's markers far from its axis have straight sides, and is scaled like the image there.
"""

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.geometry import Array

_DEGREE = 5
TERMS = 21
_GRID = np.stack(np.meshgrid(*2 * [1.3 * np.sin(np.linspace(-1, 1, 8) * np.pi / 2)]), -1)
_PLACES = _GRID.reshape(-1, 2)
NO_LENS = np.zeros((0, 2))


def _powers(places: Array) -> Array:
    """Return x^i y^j, i + j <= 5, for places (..., 2), shape (..., 21)."""
    x, y = places[..., 0], places[..., 1]
    terms = [x**i * y**j for i in range(_DEGREE + 1) for j in range(_DEGREE + 1 - i)]
    return np.stack(terms, axis=-1)


_SOLVER = np.linalg.pinv(_powers(_PLACES))
_X, _Y, _ONE = (_DEGREE + 1, 1, 0)  # where the terms x, y and 1 stand


def lens_around(camera: Camera, frame: Array) -> Array:
    """Return the coefficients of the map around a marker, (21, 2); none where there is no map.

    Args:
        camera: Intrinsics.
        frame: Middle x, y and half diagonal of the marker, pixels.
    """
    if not camera.lens.coefficients:
        return NO_LENS
    rays = camera.unproject(frame[:2] + frame[2] * _PLACES)
    ahead = camera.unproject(frame[:2])
    if not (np.isfinite(rays).all() and np.isfinite(ahead).all()):
        return NO_LENS
    across = np.linalg.svd(ahead[None])[2][1:]
    depth = rays @ ahead
    if depth.min() < 0.1:
        return NO_LENS
    coefficients = _SOLVER @ ((rays @ across.T) / depth[:, None])
    coefficients[_ONE] = 0.0
    slope = coefficients[[_X, _Y]]
    return np.asarray(coefficients @ np.linalg.inv(slope))


@kernel
def straight_place(x: float, y: float, lens: Array) -> tuple[float, float]:
    """Return where a place of the image lies in the straight image; itself without a lens."""
    if len(lens) == 0:
        return x, y
    to_x, to_y, term, power_x = 0.0, 0.0, 0, 1.0
    for i in range(_DEGREE + 1):
        power = power_x
        for _ in range(_DEGREE + 1 - i):
            to_x += lens[term, 0] * power
            to_y += lens[term, 1] * power
            power *= y
            term += 1
        power_x *= x
    return to_x, to_y
