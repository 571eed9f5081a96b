"""The fit of a blurred crossing of two edges to pixels, in compiled code; `saddles` has the model.

The unknowns: the crossing's place x and y from the guess, the directions of both edges' normals,
the logarithm of the blur, the mean grey and half the contrast.
"""

import math

import numpy as np
from numba import njit

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels, IntArray

UNKNOWNS = 7
BLUR, MEAN, HALF_CONTRAST = 4, 5, 6
_STEPS = 15
_SETTLED = 1e-3
_LARGEST_HALF_PX = 16.0  # beyond, a lens' curves cost more than longer edges give
_LEAST_HALF_PX = 2.0
_LOG_BLUR = (math.log(0.2), math.log(20.0))
_LEAST_AREA_PX2 = 1e-6
_FLAT = 6.0  # blurs from an edge beyond which it is black or white to 1e-9
_SLOPE = math.sqrt(2 / math.pi)


@njit(cache=True, nogil=True)
def fit_crossings(
    grey: GreyPixels, guesses_px: Array, steps_px: Array, half: float, arm: float
) -> tuple[Array, Array, Array, IntArray]:
    """Return the unknowns (n, 7), J'J there (n, 7, 7), squared residuals and pixels used (n,).

    Args:
        grey: 8-bit image, shape (height, width).
        guesses_px: Where the crossings are about, shape (n, 2).
        steps_px: The steps to the next ones, one in each column, shape (n, 2, 2).
        half: Half the window's side, as a share of the steps.
        arm: How far from an edge pixels may lie, as a share of the steps.
    """
    n = len(guesses_px)
    unknowns, curvatures = np.zeros((n, UNKNOWNS)), np.zeros((n, UNKNOWNS, UNKNOWNS))
    squares, counts = np.zeros(n), np.zeros(n, np.int64)
    for i in range(n):
        pixels = _pixels_around(grey, guesses_px[i], steps_px[i], half, arm)
        counts[i] = len(pixels)
        if counts[i] > UNKNOWNS:
            _start(pixels, steps_px[i], unknowns[i])
            squares[i] = _descend(pixels, unknowns[i], curvatures[i])
    return unknowns, curvatures, squares, counts


@njit(cache=True, nogil=True)
def _pixels_around(
    grey: GreyPixels, guess_px: Array, steps_px: Array, half: float, arm: float
) -> Array:
    """Return the pixels of a window along the steps: x and y from the guess, and grey, (k, 3)."""
    (ax, bx), (ay, by) = steps_px
    area = ax * by - ay * bx
    if not abs(area) > _LEAST_AREA_PX2:
        return np.zeros((0, 3))
    most_u, most_v = _limit(half, math.hypot(ax, ay)), _limit(half, math.hypot(bx, by))
    reach_x = math.ceil(abs(ax) * most_u + abs(bx) * most_v)
    reach_y = math.ceil(abs(ay) * most_u + abs(by) * most_v)
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
def _limit(half: float, length_px: float) -> float:
    return min(max(half, _LEAST_HALF_PX / length_px), _LARGEST_HALF_PX / length_px)


@njit(cache=True, nogil=True)
def _start(pixels: Array, steps_px: Array, unknowns: Array) -> None:
    """Write first unknowns: the guess itself, edges along the steps, the contrast that fits."""
    (ax, bx), (ay, by) = steps_px
    shortest_px = min(math.hypot(ax, ay), math.hypot(bx, by))
    unknowns[2], unknowns[3] = math.atan2(ax, -ay), math.atan2(bx, -by)
    unknowns[BLUR] = math.log(min(max(0.06 * shortest_px, 0.7), 4.0))
    unknowns[HALF_CONTRAST] = 1.0
    mean, alike, power = pixels[:, 2].mean(), 0.0, 1e-9
    J, numbers = np.zeros(UNKNOWNS), _numbers(unknowns)
    for x, y, seen in pixels:
        pattern = _value(x, y, numbers, J)
        alike += pattern * (seen - mean)
        power += pattern * pattern
    unknowns[MEAN], unknowns[HALF_CONTRAST] = mean, alike / power


@njit(cache=True, nogil=True)
def _descend(pixels: Array, unknowns: Array, curvature: Array) -> float:
    """Go downhill by Levenberg and Marquardt; write unknowns and J'J, return the squares left."""
    gradient, new_gradient = np.zeros(UNKNOWNS), np.zeros(UNKNOWNS)
    new_curvature = np.zeros((UNKNOWNS, UNKNOWNS))
    squares, damping = _normal(pixels, unknowns, curvature, gradient), 1e-2
    for _ in range(_STEPS):
        damped = curvature.copy()
        for a in range(UNKNOWNS):
            damped[a, a] += damping * curvature[a, a] + 1e-9
        moved = unknowns + np.linalg.solve(damped, gradient)
        moved[BLUR] = min(max(moved[BLUR], _LOG_BLUR[0]), _LOG_BLUR[1])
        far = np.abs(moved - unknowns).max()
        new_squares = _normal(pixels, moved, new_curvature, new_gradient)
        if new_squares < squares:
            unknowns[:], curvature[:], gradient[:] = moved, new_curvature, new_gradient
            squares, damping = new_squares, damping / 5
        else:
            damping *= 5
        if far < _SETTLED:
            break
    return squares


@njit(cache=True, nogil=True)
def _normal(pixels: Array, unknowns: Array, curvature: Array, gradient: Array) -> float:
    """Write J'J and J'r, return r'r."""
    curvature[:], gradient[:] = 0.0, 0.0
    J, squares, numbers = np.zeros(UNKNOWNS), 0.0, _numbers(unknowns)
    for k in range(len(pixels)):
        residual = pixels[k, 2] - _value(pixels[k, 0], pixels[k, 1], numbers, J)
        squares += residual * residual
        for a in range(UNKNOWNS):
            gradient[a] += J[a] * residual
            for b in range(a + 1):
                curvature[a, b] += J[a] * J[b]
    for a in range(UNKNOWNS):
        for b in range(a):
            curvature[b, a] = curvature[a, b]
    return squares


@njit(cache=True, nogil=True)
def _numbers(unknowns: Array) -> tuple[float, ...]:
    """Return what all pixels share: place, cosines and sines, blur, mean, half the contrast."""
    x, y, turn1, turn2, log_blur, mean, half_contrast = unknowns
    cos1, sin1, cos2, sin2 = math.cos(turn1), math.sin(turn1), math.cos(turn2), math.sin(turn2)
    return x, y, cos1, sin1, cos2, sin2, math.exp(log_blur), mean, half_contrast


@njit(cache=True, nogil=True)
def _value(x: float, y: float, numbers: tuple[float, ...], J: Array) -> float:
    """Return the model's grey value and write its derivatives."""
    cx, cy, cos1, sin1, cos2, sin2, blur, mean, half_contrast = numbers
    x, y = x - cx, y - cy
    across1, across2 = cos1 * x + sin1 * y, cos2 * x + sin2 * y
    edge1, slope1 = _edge(across1 / blur)
    edge2, slope2 = _edge(across2 / blur)
    by1, by2 = half_contrast * slope1 * edge2 / blur, half_contrast * edge1 * slope2 / blur
    J[0], J[1] = -by1 * cos1 - by2 * cos2, -by1 * sin1 - by2 * sin2
    J[2], J[3] = by1 * (cos1 * y - sin1 * x), by2 * (cos2 * y - sin2 * x)
    J[BLUR], J[MEAN], J[HALF_CONTRAST] = -by1 * across1 - by2 * across2, 1.0, edge1 * edge2
    return mean + half_contrast * edge1 * edge2


@njit(cache=True, nogil=True)
def _edge(across: float) -> tuple[float, float]:
    """Return an edge's grey value, -1 to 1, and its slope, `across` counted in blurs."""
    if abs(across) > _FLAT:
        return math.copysign(1.0, across), 0.0
    return math.erf(across / math.sqrt(2.0)), _SLOPE * math.exp(-0.5 * across * across)
