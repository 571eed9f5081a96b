"""The fit of a blurred crossing of two edges to pixels, in compiled code; `saddles` has the model.

The unknowns: the crossing's place x and y from the guess, the directions of both edges' normals,
the logarithm of the blur, the mean grey, half the contrast, and by which share the light grows from
pixel to pixel along x and y. Away from the edges only the light's own numbers matter.
"""

import math

import numpy as np
from numba import njit

from tagmetry.calibrate.targets.window import pixels_around, thickness_px
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels, IntArray

UNKNOWNS, UNKNOWNS_IN_EVEN_LIGHT = 9, 7
BLUR, MEAN, HALF_CONTRAST = 4, 5, 6
_SHADE_X, _SHADE_Y = 7, 8
_FIRST_BLURS_PX = (0.7, 1.4, 2.8, 5.6)
_LOOKED_AT = 3  # every so many pixels, to begin with
_STEPS = 15
_SETTLED = 1e-3
_SHADE, _SHADE_NOISE = 0.05, 3.0  # how much light changes over a step, believed at this noise
_LOG_BLUR = (math.log(0.2), math.log(20.0))
_FLAT = 5.0  # blurs from an edge beyond which it is black or white to 1e-6
_SLOPE = math.sqrt(2 / math.pi)


@njit(cache=True, nogil=True)
def fit_crossings(
    greys: GreyPixels,
    guesses_px: Array,
    steps_px: Array,
    bends: Array,
    half: float,
    arm: float,
    free: int,
) -> tuple[Array, Array, Array, IntArray]:
    """Return the unknowns (n, 9), J'J there (n, free, free), squared residuals, pixels used (n,).

    Args:
        greys: 8-bit images, shape (1 or n, height, width): one for all, or one for each.
        guesses_px: Where the crossings are about, shape (n, 2), in their own image.
        steps_px: The steps to the next ones, one in each column, shape (n, 2, 2).
        bends: Curvature of the edge along each step, shape (n, 2), 1 / px; positive where it bends
            from the step's direction toward (-y, x) of it, which is a turn from x to y.
        half: Half the window's side, as a share of the steps.
        arm: How far from an edge pixels may lie, as a share of the steps.
        free: How many of the unknowns are, 7 (in even light) or 9.
    """
    n = len(guesses_px)
    unknowns, curvatures = np.zeros((n, UNKNOWNS)), np.zeros((n, free, free))
    squares, counts = np.zeros(n), np.zeros(n, np.int64)
    for i in range(n):
        grey = greys[min(i, len(greys) - 1)]
        pixels = pixels_around(grey, guesses_px[i], steps_px[i], half, arm)
        counts[i] = len(pixels)
        if counts[i] > free:
            _start(pixels, steps_px[i], bends[i], unknowns[i])
            evenness = (_SHADE_NOISE / _SHADE * thickness_px(steps_px[i])) ** 2
            squares[i] = _descend(pixels, bends[i], evenness, unknowns[i], curvatures[i])
    return unknowns, curvatures, squares, counts


@njit(cache=True, nogil=True)
def _start(pixels: Array, steps_px: Array, bends: Array, unknowns: Array) -> None:
    """Write first unknowns: the guess itself, edges along the steps, the blur that fits best."""
    (ax, bx), (ay, by) = steps_px
    unknowns[2], unknowns[3] = math.atan2(ax, -ay), math.atan2(bx, -by)
    unknowns[HALF_CONTRAST] = 1.0
    mean, most, best = pixels[:, 2].mean(), -1.0, _FIRST_BLURS_PX[0]
    J, contrast = np.zeros(UNKNOWNS), 0.0
    for blur_px in _FIRST_BLURS_PX:
        unknowns[BLUR] = math.log(blur_px)
        numbers, alike, power = _numbers(unknowns, bends), 0.0, 1e-9
        for x, y, seen in pixels[::_LOOKED_AT]:
            pattern = _value(x, y, numbers, J)[0]
            alike += pattern * (seen - mean)
            power += pattern * pattern
        if alike * alike / power > most:
            most, best, contrast = alike * alike / power, blur_px, alike / power
    unknowns[BLUR], unknowns[MEAN], unknowns[HALF_CONTRAST] = math.log(best), mean, contrast


@njit(cache=True, nogil=True)
def _descend(
    pixels: Array, bends: Array, evenness: float, unknowns: Array, curvature: Array
) -> float:
    """Go downhill by Levenberg and Marquardt; write unknowns and J'J, return the squares left."""
    free = len(curvature)
    gradient, new_gradient = np.zeros(free), np.zeros(free)
    new_curvature, moved = np.zeros((free, free)), unknowns.copy()
    squares, damping = _normal(pixels, bends, evenness, unknowns, curvature, gradient), 1e-2
    for _ in range(_STEPS):
        damped = curvature.copy()
        for a in range(free):
            damped[a, a] += damping * curvature[a, a] + 1e-9
        moved[:free] = unknowns[:free] + np.linalg.solve(damped, gradient)
        moved[BLUR] = min(max(moved[BLUR], _LOG_BLUR[0]), _LOG_BLUR[1])
        far = np.abs(moved - unknowns)[:MEAN].max()
        new_squares = _normal(pixels, bends, evenness, moved, new_curvature, new_gradient)
        if new_squares < squares:
            unknowns[:], curvature[:], gradient[:] = moved, new_curvature, new_gradient
            squares, damping = new_squares, damping / 5
        else:
            damping *= 5
        if far < _SETTLED:
            break
    return squares


@njit(cache=True, nogil=True)
def _normal(
    pixels: Array,
    bends: Array,
    evenness: float,
    unknowns: Array,
    curvature: Array,
    gradient: Array,
) -> float:
    """Write J'J and J'r, return r'r; even light is believed with a weight."""
    curvature[:], gradient[:] = 0.0, 0.0
    free, squares = len(gradient), 0.0
    J, numbers = np.zeros(UNKNOWNS), _numbers(unknowns, bends)
    for k in range(len(pixels)):
        value, first = _value(pixels[k, 0], pixels[k, 1], numbers, J)
        residual = pixels[k, 2] - value
        squares += residual * residual
        for a in range(first, free):
            gradient[a] += J[a] * residual
            for b in range(first, a + 1):
                curvature[a, b] += J[a] * J[b]
    for a in range(_SHADE_X, free):
        squares += evenness * unknowns[a] ** 2
        gradient[a] -= evenness * unknowns[a]
        curvature[a, a] += evenness
    for a in range(free):
        for b in range(a):
            curvature[b, a] = curvature[a, b]
    return squares


@njit(cache=True, nogil=True)
def _numbers(unknowns: Array, bends: Array) -> tuple[tuple[float, ...], ...]:
    """Return what all pixels share: place, blur and slant, the two edges, and the light."""
    x, y, turn1, turn2, log_blur, mean, half_contrast, shade_x, shade_y = unknowns
    edge1 = (math.cos(turn1), math.sin(turn1), bends[0])
    edge2 = (math.cos(turn2), math.sin(turn2), bends[1])
    where = (x, y, math.exp(log_blur), math.cos(turn1 - turn2))
    return where, edge1, edge2, (mean, half_contrast, shade_x, shade_y)


@njit(cache=True, nogil=True)
def _value(
    x: float, y: float, numbers: tuple[tuple[float, ...], ...], J: Array
) -> tuple[float, int]:
    """Return the model's grey value and the first derivative that is not zero; write them all."""
    (cx, cy, blur, slant), edge1, edge2, (mean, half_contrast, shade_x, shade_y) = numbers
    across1, slant1_x, slant1_y = _across(x - cx, y - cy, edge1, blur)
    across2, slant2_x, slant2_y = _across(x - cx, y - cy, edge2, blur)
    side1, slope1 = _edge(across1 / blur)
    side2, slope2 = _edge(across2 / blur)
    both, by_both1, by_both2 = _both(across1 / blur, across2 / blur, slant)
    light, pattern = 1 + shade_x * x + shade_y * y, side1 * side2 + slope1 * slope2 * both
    value = mean + half_contrast * pattern
    J[MEAN], J[HALF_CONTRAST] = light, light * pattern
    J[_SHADE_X], J[_SHADE_Y] = value * x, value * y
    if slope1 == 0.0 and slope2 == 0.0:
        return value * light, MEAN
    strength = half_contrast * light / blur
    by1 = strength * slope1 * (side2 + slope2 * by_both1)
    by2 = strength * slope2 * (side1 + slope1 * by_both2)
    J[0], J[1] = -by1 * slant1_x - by2 * slant2_x, -by1 * slant1_y - by2 * slant2_y
    J[2] = by1 * (slant1_x * (y - cy) - slant1_y * (x - cx))
    J[3] = by2 * (slant2_x * (y - cy) - slant2_y * (x - cx))
    J[BLUR] = -by1 * across1 - by2 * across2
    return value * light, 0


@njit(cache=True, nogil=True)
def _both(a: float, b: float, slant: float) -> tuple[float, float, float]:
    """Return what slanted edges add to the product of two, over both slopes, and its slopes.

    The mean of sign(a + z1) sign(b + z2) over normal z1 and z2 of correlation r is the sum over k
    of r^k / k! g^(k)(a) g^(k)(b), g = erf(. / sqrt(2)) (Mehler); r^4 and beyond are left out.
    """
    r1, r2, r3 = slant, slant * slant / 2, slant * slant * slant / 6
    bend_a, bend_b = a * a - 1, b * b - 1
    value = r1 + r2 * a * b + r3 * bend_a * bend_b
    by_a = -r1 * a - r2 * bend_a * b + r3 * a * (3 - a * a) * bend_b
    by_b = -r1 * b - r2 * bend_b * a + r3 * b * (3 - b * b) * bend_a
    return value, by_a, by_b


@njit(cache=True, nogil=True)
def _across(x: float, y: float, edge: tuple[float, ...], blur: float) -> tuple[float, float, float]:
    """Return how far a pixel lies across a bent edge, and that distance's slope along x and y.

    Blur moves a bent edge by half its curvature times the blur squared.
    """
    cos, sin, bend = edge
    along = sin * x - cos * y
    across = cos * x + sin * y - 0.5 * bend * (along * along + blur * blur)
    return across, cos - bend * along * sin, sin + bend * along * cos


@njit(cache=True, nogil=True)
def _edge(across: float) -> tuple[float, float]:
    """Return an edge's grey value, -1 to 1, and its slope, `across` counted in blurs."""
    if abs(across) > _FLAT:
        return math.copysign(1.0, across), 0.0
    return math.erf(across / math.sqrt(2.0)), _SLOPE * math.exp(-0.5 * across * across)
