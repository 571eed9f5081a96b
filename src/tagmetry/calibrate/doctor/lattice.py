"""Which chessboard is in a picture, whatever was asked for?

A finder is begun with few corners and grows; where it stops too early, the squares beyond its last
corners tell that there are more.
"""

from collections.abc import Sequence

import cv2
import numpy as np

from tagmetry.calibrate.targets.chessboard import find_chessboard
from tagmetry.calibrate.targets.found import Found
from tagmetry.calibrate.targets.squares import is_even, share_alternating, square_greys
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import Chessboard

Counts = tuple[int, int]

_SEEDS: tuple[Counts, ...] = ((5, 4), (4, 3))
_GROWING = cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_LARGER
_LONGEST_PX = 1000
_ALTERNATING = 0.9
_AS_STRONG = 0.5  # of the board's contrast


def corners_as(grey: GreyPixels, counts: Counts) -> Array | None:
    """Return the corners of a chessboard of so many, (rows, columns, 2); None where there is none.

    Args:
        grey: 8-bit image.
        counts: Inner corners in a row, and rows of them.
    """
    columns, rows = counts
    found = find_chessboard(grey, Chessboard(columns, rows, 1.0), thorough=False)
    if not isinstance(found, Found) or len(found.points) < columns * rows:
        return None
    return found.corners_px.reshape(rows, columns, 2)


def largest_lattice(grey: GreyPixels) -> Counts | None:
    """Return how many corners in a row and rows of a chessboard are seen; None where none is."""
    scale = max(1.0, max(grey.shape) / _LONGEST_PX)
    size = (max(1, round(grey.shape[1] / scale)), max(1, round(grey.shape[0] / scale)))
    small = np.asarray(cv2.resize(grey, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    for seed in _SEEDS:
        found, corners, meta = cv2.findChessboardCornersSBWithMeta(small, seed, _GROWING)
        if found:
            rows, columns = np.shape(meta)[:2]
            grid = np.asarray(corners, dtype=np.float64).reshape(rows, columns, 2)
            if is_even(grid) and share_alternating(square_greys(small, grid)) >= _ALTERNATING:
                return grown(small, grid)
    return None


def grown(grey: GreyPixels, grid_px: Array) -> Counts:
    """Return the counts of corners (rows, columns, 2) with the lines of squares beyond them."""
    rows, columns = grid_px.shape[:2]
    down = sum(_goes_on(grey, one) for one in (grid_px, grid_px[::-1]))
    turned = np.swapaxes(grid_px, 0, 1)
    across = sum(_goes_on(grey, one) for one in (turned, turned[::-1]))
    return columns + across, rows + down


def voted(counts: Sequence[Counts]) -> tuple[Counts, int]:
    """Return the counts that most pictures show, whichever way round, and how many do."""
    upright = [(max(one), min(one)) for one in counts]
    best = max(set(upright), key=lambda one: (upright.count(one), one))
    return best, upright.count(best)


def _goes_on(grey: GreyPixels, grid_px: Array) -> bool:
    """Say whether another line of squares lies above the board's first, which no corner is in."""
    step = grid_px[0] - grid_px[1]
    bend = step - (grid_px[1] - grid_px[2]) if len(grid_px) > 2 else np.zeros_like(step)
    lines = [grid_px[0] + k * step + 0.5 * k * (k + 1) * bend for k in (2, 1)]
    strip = np.stack([*lines, grid_px[0], grid_px[1]])
    if (strip < 1).any() or (strip > np.array(grey.shape[::-1]) - 2).any():
        return False
    greys = square_greys(grey, strip)
    sign = np.where(np.indices(greys.shape).sum(axis=0) % 2 == 0, 1.0, -1.0)
    contrasts = (sign * (greys - greys.mean(axis=1, keepdims=True))).mean(axis=1)
    inside = contrasts[2]
    return bool(contrasts[0] * np.sign(inside) > _AS_STRONG * abs(inside))
