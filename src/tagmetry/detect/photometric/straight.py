"""Pixels as a camera without distortion would see them, around one marker.

Within a marker the lens's map is a polynomial of fifth degree to a ten-thousandth of a pixel; it is
taken from the camera once per marker, so that no pixel needs the lens's own, slower formula. The
straight image is the plane across the ray through the marker's middle (gnomonic), so that even a
fisheye's markers far from its axis have straight sides, and is scaled like the image there.
"""

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.geometry import Array

_DEGREE = 5
TERMS = 21
_GRID = np.stack(np.meshgrid(*2 * [1.3 * np.sin(np.linspace(-1, 1, 8) * np.pi / 2)]), -1)
_PLACES = _GRID.reshape(-1, 2)


def _powers(places: Array) -> Array:
    """Return x^i y^j, i + j <= 5, for places (..., 2), shape (..., 21)."""
    x, y = places[..., 0], places[..., 1]
    terms = [x**i * y**j for i in range(_DEGREE + 1) for j in range(_DEGREE + 1 - i)]
    return np.stack(terms, axis=-1)


_SOLVER = np.linalg.pinv(_powers(_PLACES))
_LEAST_DEPTH = 0.1  # of rays, along the one to the middle
_X, _Y, _ONE = (_DEGREE + 1, 1, 0)  # where the terms x, y and 1 stand


def lenses_around(camera: Camera | None, frames: Array) -> Array:
    """Return the coefficients of the maps around n markers, (n, 21, 2); without a lens (n, 0, 2).

    Where the camera does not see all around a marker, its map changes nothing.

    Args:
        camera: Intrinsics.
        frames: Middle x, y and half diagonal of the markers, pixels, shape (n, 3).
    """
    if camera is None or not camera.lens.coefficients:
        return np.zeros((len(frames), 0, 2))
    around = frames[:, None, :2] + frames[:, None, 2:] * _PLACES
    rays, ahead = camera.unproject(around), camera.unproject(frames[:, :2])
    seen = np.isfinite(rays).all(axis=(1, 2)) & np.isfinite(ahead).all(axis=1)
    depth = np.einsum("nkc,nc->nk", rays, ahead)
    seen &= depth.min(axis=1) > _LEAST_DEPTH
    lenses = np.zeros((len(frames), TERMS, 2))
    lenses[:, [_X, _Y]] = np.eye(2)
    if seen.any():
        across = np.linalg.svd(ahead[seen][:, None])[2][:, 1:]
        flat = (rays[seen] @ np.swapaxes(across, 1, 2)) / depth[seen][..., None]
        lenses[seen] = _scaled_like_image(_SOLVER @ flat)
    return lenses


def _scaled_like_image(coefficients: Array) -> Array:
    """Return maps that change neither the middle nor, there, the scale, (n, 21, 2)."""
    coefficients[:, _ONE] = 0.0
    slope = coefficients[:, [_X, _Y]]
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


@kernel
def straighten(room: Array, lens: Array) -> None:
    """Replace the places of a block of pixels by those in the straight image."""
    if len(lens) == 0:
        return
    for p in range(row.BLOCK):
        x, y = straight_place(room[row.X + p], room[row.Y + p], lens)
        room[row.X + p], room[row.Y + p] = x, y


@kernel
def bend_of(lens: Array) -> float:
    """Return how far the lens moves places about the marker at most, half diagonals."""
    if len(lens) == 0:
        return 0.0
    farthest = 0.0
    for x in (-1.2, 1.2):
        for y in (-1.2, 1.2):
            to_x, to_y = straight_place(x, y, lens)
            farthest = max(farthest, abs(to_x - x), abs(to_y - y))
    return farthest
