"""The pixels of a window that follows a corner's squares, in compiled code."""

import math

import numpy as np
from numba import njit

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_LEAST_HALF_PX = 2.0
MOST_HALF_PX = 16.0  # longer edges tell little more and cost time, but for
_MOST_HALF = 0.12  # so much of a step: pictures with steps of hundreds of pixels are blurred
_LEAST_AREA_PX2 = 1e-6


@njit(cache=True, nogil=True)
def pixels_around(
    grey: GreyPixels, guess_px: Array, steps_px: Array, half: float, arm: float
) -> Array:
    """Return the pixels of a window along the steps: x and y from the guess, and grey, (k, 3).

    Args:
        grey: 8-bit image, shape (height, width).
        guess_px: The window's middle, shape (2,).
        steps_px: The steps to the next corners, one in each column, shape (2, 2).
        half: Half the window's side, as a share of the steps.
        arm: How far from the lines along the steps pixels may lie, as a share of the steps.
    """
    (ax, bx), (ay, by) = steps_px
    area = ax * by - ay * bx
    if not abs(area) > _LEAST_AREA_PX2:
        return np.zeros((0, 3))
    most_u, most_v = _limits(steps_px, half)
    reach_x, reach_y = reach_px(steps_px, half)
    column, row = round(guess_px[0]), round(guess_px[1])
    rows = range(max(0, row - reach_y), min(grey.shape[0], row + reach_y + 1))
    columns = range(max(0, column - reach_x), min(grey.shape[1], column + reach_x + 1))
    pixels, count = np.empty((len(rows) * len(columns), 3)), 0
    for r in rows:
        for c in columns:
            x, y = c - guess_px[0], r - guess_px[1]
            u, v = abs(by * x - bx * y) / abs(area), abs(ax * y - ay * x) / abs(area)
            if u <= most_u and v <= most_v and min(u, v) <= arm:
                pixels[count, 0], pixels[count, 1], pixels[count, 2] = x, y, grey[r, c]
                count += 1
    return pixels[:count]


@njit(cache=True, nogil=True)
def reach_px(steps_px: Array, half: float) -> tuple[int, int]:
    """Return how many columns and rows a window reaches from its middle."""
    most_u, most_v = _limits(steps_px, half)
    (ax, bx), (ay, by) = steps_px
    columns = math.ceil(abs(ax) * most_u + abs(bx) * most_v)
    return columns, math.ceil(abs(ay) * most_u + abs(by) * most_v)


@njit(cache=True, nogil=True)
def _limits(steps_px: Array, half: float) -> tuple[float, float]:
    """Return half the sides as shares of the two steps."""
    (ax, bx), (ay, by) = steps_px
    return _limit(half, math.hypot(ax, ay)), _limit(half, math.hypot(bx, by))


@njit(cache=True, nogil=True)
def _limit(half: float, length_px: float) -> float:
    """Return half the side as a share of a step of some length."""
    most = max(MOST_HALF_PX / length_px, _MOST_HALF)
    return min(max(half, _LEAST_HALF_PX / length_px), most)


@njit(cache=True, nogil=True)
def thickness_px(steps_px: Array) -> float:
    """Return how far apart the longer sides of a square are."""
    (ax, bx), (ay, by) = steps_px
    area, longest = abs(ax * by - ay * bx), max(math.hypot(ax, ay), math.hypot(bx, by))
    return float(area / longest)
