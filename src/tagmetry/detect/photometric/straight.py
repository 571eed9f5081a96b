"""Pixels as a camera without distortion would see them, around one marker.

Within a marker the lens's map is a polynomial of fifth degree to a ten-thousandth of a pixel; it is
taken from the camera once per marker, so that no pixel needs the lens's own, slower formula. The
straight image is the plane across the ray through the marker's middle (gnomonic), so that even a
fisheye's markers far from its axis have straight sides, and is scaled like the image there.
"""

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.detect.photometric.rays import rays_of
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
    pixels = np.concatenate([frames[:, None, :2], around], axis=1)
    rays = rays_of(camera, pixels.reshape(-1, 2)).reshape(len(frames), -1, 3)
    ahead, rays = rays[:, 0], rays[:, 1:]
    seen = np.isfinite(rays).all(axis=(1, 2)) & np.isfinite(ahead).all(axis=1)
    depth = np.einsum("nkc,nc->nk", rays, ahead)
    seen &= depth.min(axis=1) > _LEAST_DEPTH
    lenses = np.zeros((len(frames), TERMS, 2))
    lenses[:, [_X, _Y]] = np.eye(2)
    if seen.any():
        flat = (rays[seen] @ _across(ahead[seen])) / depth[seen][..., None]
        lenses[seen] = _scaled_like_image(_SOLVER @ flat)
    return lenses


def _across(ahead: Array) -> Array:
    """Return two unit vectors across each of n rays, at right angles, shape (n, 3, 2).

    They are what the axes x and y become when z is mirrored onto the ray (Householder).
    """
    mirror = ahead.copy()
    mirror[:, 2] += np.copysign(1.0, ahead[:, 2])
    twice = 2.0 / (mirror**2).sum(axis=1)
    return np.asarray(
        np.eye(3)[:, :2] - twice[:, None, None] * mirror[:, :, None] * mirror[:, None, :2]
    )


def _scaled_like_image(coefficients: Array) -> Array:
    """Return maps that change neither the middle nor, there, the scale, (n, 21, 2)."""
    coefficients[:, _ONE] = 0.0
    slope = coefficients[:, [_X, _Y]]
    return np.asarray(coefficients @ np.linalg.inv(slope))


@kernel
def straight_place(x: float, y: float, lens: Array | Narrow) -> tuple[float, float]:
    """Return where a place of the image lies in the straight image; itself without a lens."""
    if len(lens) == 0:
        return x, y
    term, to_x, to_y = TERMS - 1, lens[TERMS - 1, 0], lens[TERMS - 1, 1]
    for power_y in range(1, _DEGREE + 1):  # Horner's scheme in x, and within it in y
        term -= 1
        along_x, along_y = lens[term, 0], lens[term, 1]
        for _ in range(power_y):
            term -= 1
            along_x, along_y = along_x * y + lens[term, 0], along_y * y + lens[term, 1]
        to_x, to_y = to_x * x + along_x, to_y * x + along_y
    return to_x, to_y


@kernel
def straighten(room: Narrow, lens: Narrow) -> None:
    """Replace the places of a block of pixels by those in the straight image, as above."""
    if len(lens) == 0:
        return
    for k in range(4 * row.BLOCK):
        room[row.U + k] = f32(0)  # U, V; UX, UY are used for the inner sums
    term = TERMS
    for power_y in range(_DEGREE + 1):
        for _ in range(power_y + 1):
            term -= 1
            _add_term(room, lens[term, 0], lens[term, 1])
        for p in range(row.BLOCK):
            room[row.U + p] = room[row.U + p] * room[row.X + p] + room[row.UX + p]
            room[row.V + p] = room[row.V + p] * room[row.X + p] + room[row.UY + p]
            room[row.UX + p], room[row.UY + p] = f32(0), f32(0)
    for k in range(2 * row.BLOCK):
        room[row.X + k] = room[row.U + k]


@kernel
def _add_term(room: Narrow, by_x: f32, by_y: f32) -> None:
    """Multiply the inner sums by y, and add a coefficient to each."""
    for p in range(row.BLOCK):
        room[row.UX + p] = room[row.UX + p] * room[row.Y + p] + by_x
        room[row.UY + p] = room[row.UY + p] * room[row.Y + p] + by_y


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
