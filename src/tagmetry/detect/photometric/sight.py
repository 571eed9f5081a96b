"""Which part of the image shows a marker: rows, and columns of each row."""

import numpy as np

from tagmetry.detect.photometric.ink import QUIET_CELLS
from tagmetry.detect.photometric.kernel import f32, kernel, step
from tagmetry.detect.photometric.model import cell_px
from tagmetry.geometry import Array

_REACH_PX = f32(3.0)  # how far outside the picture pixels are looked at, at most
_REACH_CELLS = f32(0.3)  # and at least
_CLEAR_PX = f32(1.5)  # this much of the quiet zone may be blurred by what lies behind it
_PLAIN_PX = 0.7  # of plain paper around them
_SPARE = 1.3  # cells are smaller where the marker is farther


@kernel
def trusted_cells(fineness: f32) -> f32:
    """Return how many cells of the quiet zone may be trusted, by the cells per pixel."""
    return min(max(f32(1) - _CLEAR_PX * fineness, _REACH_CELLS), _REACH_PX * fineness)


@kernel
def is_trusted(outside: f32, fineness2: f32) -> bool:
    """Say whether so many cells outside the picture may be trusted, by the square of the above."""
    spare, far = f32(1) - outside, outside > f32(0)
    clear = (outside < _REACH_CELLS) | (
        (_CLEAR_PX * _CLEAR_PX * fineness2 < spare * spare) & (spare > f32(0))
    )
    near = outside * outside < _REACH_PX * _REACH_PX * fineness2
    return bool((clear & near) | ~far)


@kernel
def limits_of(fit: Array, half_px: float, cells: int, beside_px: float) -> tuple[float, float]:
    """Return the first and last cell coordinate that is looked at, for edges seen so far away."""
    fineness = 1.0 / cell_px(fit, half_px)
    outside = min(float(trusted_cells(f32(fineness))), (beside_px + _PLAIN_PX) * fineness)
    outside = min(_SPARE * outside, 1.0)
    return QUIET_CELLS - outside, cells - QUIET_CELLS + outside


@kernel
def rows_in_sight(
    fit: Array, frame: Array, limits: tuple[float, float], height: int, bend: float
) -> tuple[int, int]:
    """Return the first and last row of the image that the picture may reach.

    `bend`: see `bend_of`.
    """
    low, high = limits
    top, bottom = np.inf, -np.inf
    for u in (low, high):
        for v in (low, high):
            a, b, c = fit[0] - u * fit[6], fit[1] - u * fit[7], u - fit[2]
            d, e, f = fit[3] - v * fit[6], fit[4] - v * fit[7], v - fit[5]
            y = (a * f - d * c) / (a * e - b * d)
            top, bottom = min(top, y), max(bottom, y)
    return _whole(frame[1], frame[2], top - bend, bottom + bend, height)


@step
def columns_in_sight(
    fit: Array, frame: Array, limits: tuple[float, float], width: int, bend: float, image_row: int
) -> tuple[int, int]:
    """Return the first and last column of a row of the image that the picture may reach.

    u > low is (fit0 - low fit6) x + (fit1 - low fit7) y + fit2 - low > 0, and so on.
    """
    y = (image_row - frame[1]) / frame[2]
    left, right = -np.inf, np.inf
    for k in (0, 3):
        for limit, sign in ((limits[0], 1.0), (limits[1], -1.0)):
            slope = sign * (fit[k] - limit * fit[6])
            along = sign * (fit[k + 1] - limit * fit[7])
            level = along * y + sign * (fit[k + 2] - limit) + bend * abs(along)
            if slope > 0.0:
                left = max(left, -level / slope)
            elif slope < 0.0:
                right = min(right, -level / slope)
    return _whole(frame[0], frame[2], left - bend, right + bend, width)


@kernel
def _whole(middle: float, half_px: float, low: float, high: float, count: int) -> tuple[int, int]:
    """Return the first and last whole pixel between two places, within the image."""
    first, last = middle + half_px * low, middle + half_px * high
    if not first <= last:
        return 0, -1
    return int(np.ceil(min(max(first, 0.0), count))), int(
        np.floor(max(min(last, count - 1.0), -1.0))
    )
