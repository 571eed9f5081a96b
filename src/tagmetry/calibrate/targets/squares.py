"""What the squares between the corners of a chessboard look like."""

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_MOST_BENT = 0.35  # how far a corner may lie from the middle of its neighbours, in steps


def is_even(grid_px: Array) -> bool:
    """Return whether every corner lies about in the middle of its neighbours.

    Lenses and tilt bend rows a little; corners that were mixed up bend them much.

    Args:
        grid_px: Shape (rows, columns, 2).
    """
    for axis in (0, 1):
        steps = np.diff(grid_px, axis=axis)
        bends = np.linalg.norm(np.diff(steps, axis=axis), axis=-1)
        lengths = np.linalg.norm(steps, axis=-1)
        before = lengths[1:] if axis == 0 else lengths[:, 1:]
        after = lengths[:-1] if axis == 0 else lengths[:, :-1]
        if (bends > _MOST_BENT * (before + after)).any():
            return False
    return True


def square_greys(grey: GreyPixels, grid_px: Array) -> Array:
    """Return the mean grey value in the middle of every square, shape (rows - 1, columns - 1)."""
    middles = (grid_px[:-1, :-1] + grid_px[1:, 1:] + grid_px[:-1, 1:] + grid_px[1:, :-1]) / 4
    height_px, width_px = grey.shape
    column = np.clip(np.rint(middles[..., 0]).astype(int), 1, width_px - 2)
    row = np.clip(np.rint(middles[..., 1]).astype(int), 1, height_px - 2)
    around = [grey[row + dy, column + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
    return np.asarray(np.mean(around, axis=0))


def share_alternating(greys: Array) -> float:
    """Return the share of neighbouring squares of opposite colours, 1 for a single square."""
    sign = np.where(np.indices(greys.shape).sum(axis=0) % 2 == 0, 1.0, -1.0)
    across = (sign * greys)[:, :-1] + (sign * greys)[:, 1:]
    down = (sign * greys)[:-1] + (sign * greys)[1:]
    pairs = np.concatenate([across.ravel(), down.ravel()])
    if pairs.size == 0:
        return 1.0
    return float(max((pairs > 0).mean(), (pairs < 0).mean()))


def first_is_black(greys: Array) -> bool:
    """Return whether the square right below the first corner is of the darker colour."""
    even = np.indices(greys.shape).sum(axis=0) % 2 == 0
    return greys.size > 1 and bool(greys[even].mean() < greys[~even].mean())
