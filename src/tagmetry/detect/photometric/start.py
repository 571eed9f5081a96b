"""From first corners to the first numbers of the model."""

import numpy as np

from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import COUNT, LOOKS
from tagmetry.detect.photometric.straight import straight_place
from tagmetry.geometry import Array, square_to_quad
from tagmetry.geometry.arrays import BoolArray

_LEAST_TURN_PX2 = 4.0


def are_squares(corners_px: Array) -> BoolArray:
    """Say which corners go clockwise around an area of some pixels, without a dent, shape (n,)."""
    along = np.roll(corners_px, -1, axis=1) - corners_px
    after = np.roll(along, -1, axis=1)
    turn = along[..., 0] * after[..., 1] - along[..., 1] * after[..., 0]
    return np.asarray((turn > _LEAST_TURN_PX2).all(axis=1))


def frames_of(corners_px: Array) -> Array:
    """Return the middle x, y and the half diagonal of markers, pixels, shape (n, 3)."""
    middle = corners_px.mean(axis=1)
    half_px = np.linalg.norm(corners_px - middle[:, None], axis=2).mean(axis=1)
    return np.concatenate([middle, half_px[:, None]], axis=1)


def first_fits(
    corners_px: Array, frames: Array, lenses: Array, squares: Array, looks: Array
) -> Array:
    """Return the numbers of the model with the homographies of first corners, shape (n, 24).

    Args:
        corners_px: Clockwise from the picture's top left, shape (n, 4, 2).
        frames: Middle x, y and half diagonal of the markers, pixels, shape (n, 3).
        lenses: See `lenses_around`.
        squares: First and last cell coordinate of the squares, shape (n, 2).
        looks: How each looked before; NaN where that is not known, shape (n, 11).
    """
    places = (corners_px - frames[:, None, :2]) / frames[:, None, 2:]
    cells = np.zeros((len(places), 3, 3))
    cells[:, 0, 0] = cells[:, 1, 1] = squares[:, 1] - squares[:, 0]
    cells[:, 0, 2] = cells[:, 1, 2] = squares[:, 0]
    cells[:, 2, 2] = 1.0
    H = square_to_quad(_straightened(places, lenses))
    fits = np.zeros((len(places), COUNT))
    with np.errstate(divide="ignore", invalid="ignore"):
        H[~(np.abs(np.linalg.det(H)) > 0)] = np.nan  # which a fit gives up
        G = cells @ np.linalg.inv(H)
        fits[:, :8] = (G / G[:, 2:, 2:]).reshape(-1, 9)[:, :8]
    fits[:, LOOKS] = np.nan_to_num(looks)
    return fits


@kernel
def _straightened(places: Array, lenses: Array) -> Array:
    """Return places of n markers, (n, 4, 2), in the straight image."""
    straight = np.empty(places.shape)
    for marker in range(len(places)):
        for corner in range(4):
            x, y = places[marker, corner, 0], places[marker, corner, 1]
            x, y = straight_place(x, y, lenses[marker])
            straight[marker, corner, 0], straight[marker, corner, 1] = x, y
    return straight
