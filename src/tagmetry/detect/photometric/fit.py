"""Gauss and Newton: the numbers of the model that explain the pixels best, and their covariance."""

import numpy as np

from tagmetry.detect.photometric.ink import MOST_EDGES
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import (
    BLACK,
    BLUR,
    COUNT,
    EXPONENT,
    SLOPES,
    levels_of,
    value_at,
)
from tagmetry.geometry import Array

_FAR = 4.0  # residuals beyond so many deviations count less
_LEAST_NOISE = 0.3  # grey values: that of rounding
_COARSE = 250  # pixels in the first rounds
_PRIOR_EXPONENT = 0.7  # of its logarithm
_PRIOR_BLUR = 1.0  # of its variances, as a share
_PRIOR_SLOPE = 0.3  # of light, across half a diagonal
_MOST_MOVE_PX = 1.5
_SETTLED_PX = 0.01
_NEARLY_PX = 0.1  # is settled for the first stages
_FIRST_NOISE = 20.0
_MOST_ROUNDS = 6  # of a stage
_FULL = 255.0
_OF_WEIGHTS = 1.228  # (E w / E (w r)')^2 of Cauchy's weights on Gaussian noise
EXPONENTS = (-0.7, 1.4)  # of their logarithm
_BLUR_PX2 = (0.1, 16.0)


@kernel
def _normal(
    fit: Array, ink: Array, pixels: Array, every: int, noise: float, count: int
) -> tuple[Array, Array, float, Array]:
    """Return J'WJ, J'Wr, the variance of the residuals, and their sizes.

    Weights are Cauchy's. The variance is that of pixels where the picture has edges: there it holds
    what the model does not describe, and it is what moves the fit.
    """
    edges, J = np.zeros((4, MOST_EDGES + 1)), np.zeros(COUNT)
    N, g = np.zeros((count, count)), np.zeros(count)
    residuals = np.zeros((len(pixels) + every - 1) // every)
    squares, edges2, levels = 0.0, 1e-12, levels_of(fit)
    for k in range(len(residuals)):
        x, y, seen = pixels[k * every]
        model = value_at(fit, levels, ink, x, y, edges, J)
        r = seen - model
        residuals[k] = abs(r)
        if seen >= _FULL and model > _FULL:
            continue  # clipped: it says no more than that
        w = 1.0 / (1.0 + (r / (_FAR * noise)) ** 2)
        slope2 = J[2] * J[2] + J[5] * J[5]
        squares += w * w * slope2 * r * r
        edges2 += w * slope2
        for a in range(count):
            wj = w * J[a]
            g[a] += wj * r
            for b in range(a + 1):
                N[a, b] += wj * J[b]
    return N, g, _OF_WEIGHTS * squares / edges2, residuals


@kernel
def _factor(N: Array, L: Array, scale: Array) -> bool:
    """Write the Cholesky factor of N scaled to a unit diagonal; False where it has none."""
    n = len(scale)
    for a in range(n):
        scale[a] = 1.0 / np.sqrt(max(N[a, a], 1e-300))
    for a in range(n):
        for b in range(a + 1):
            s = N[a, b] * scale[a] * scale[b] + (1e-10 if a == b else 0.0)
            for c in range(b):
                s -= L[a, c] * L[b, c]
            if a > b:
                L[a, b] = s / L[b, b]
            elif s <= 0.0:
                return False
            else:
                L[a, a] = np.sqrt(s)
    return True


@kernel
def _solved(L: Array, scale: Array, g: Array) -> Array:
    n = len(scale)
    x = np.zeros(n)
    for a in range(n):
        s = g[a] * scale[a]
        for c in range(a):
            s -= L[a, c] * x[c]
        x[a] = s / L[a, a]
    for a in range(n - 1, -1, -1):
        s = x[a]
        for c in range(a + 1, n):
            s -= L[c, a] * x[c]
        x[a] = s / L[a, a]
    return x * scale


@kernel
def _limited(fit: Array, half_px: float) -> None:
    """Keep levels, exponent and blur where the model means something."""
    for k in range(2):
        fit[BLACK + k] = min(max(fit[BLACK + k], 0.5 / 255), 4.0)
    fit[EXPONENT] = min(max(fit[EXPONENT], EXPONENTS[0]), EXPONENTS[1])
    low, high = _BLUR_PX2[0] / half_px**2, _BLUR_PX2[1] / half_px**2
    fit[BLUR] = min(max(fit[BLUR], low), high)
    fit[BLUR + 2] = min(max(fit[BLUR + 2], low), high)
    most = max(0.0, np.sqrt((fit[BLUR] - 0.8 * low) * (fit[BLUR + 2] - 0.8 * low)))
    fit[BLUR + 1] = min(max(fit[BLUR + 1], -most), most)


@kernel
def _moved_px(fit: Array, step: Array, half_px: float) -> float:
    """Return about how far a step moves the marker's picture."""
    cell_px = half_px / np.sqrt(abs(fit[0] * fit[4] - fit[1] * fit[3]))
    across = abs(step[0]) + abs(step[1]) + abs(step[2])
    down = abs(step[3]) + abs(step[4]) + abs(step[5])
    return float(cell_px * max(across, down))


@kernel
def _shorten(fit: Array, step: Array, half_px: float) -> float:
    """Keep a step where the model may be taken as linear; return how far it moves the picture."""
    moved_px = _moved_px(fit, step, half_px)
    step[:8] /= max(1.0, moved_px / _MOST_MOVE_PX)
    if len(step) > BLUR:
        step[EXPONENT] = min(max(step[EXPONENT], -0.4), 0.4)
        most = 0.5 * (fit[BLUR] + fit[BLUR + 2])
        largest = max(abs(step[BLUR]), abs(step[BLUR + 1]), abs(step[BLUR + 2]))
        step[BLUR : BLUR + 3] /= max(1.0, 2 * largest / most)
    return moved_px


@kernel
def _add_priors(N: Array, g: Array, fit: Array, noise: float) -> None:
    """Add what is known beforehand: exponents near 1, blur alike in all directions, even light."""
    exponent = (noise / _PRIOR_EXPONENT) ** 2
    N[EXPONENT, EXPONENT] += exponent
    g[EXPONENT] -= exponent * fit[EXPONENT]
    mean = 0.5 * (fit[BLUR] + fit[BLUR + 2])
    for k in range(3):
        blur = (noise / (_PRIOR_BLUR * mean)) ** 2
        N[BLUR + k, BLUR + k] += blur
        g[BLUR + k] -= blur * (fit[BLUR + k] - (0.0 if k == 1 else mean))
    light = (noise / _PRIOR_SLOPE) ** 2
    for k in range(SLOPES, EXPONENT):
        N[k, k] += light
        g[k] -= light * fit[k]


@kernel
def fit_pixels(
    start: Array, ink: Array, pixels: Array, half_px: float, most: int
) -> tuple[Array, Array, float, float]:
    """Return the numbers that explain the pixels best.

    Place and levels come first, from few pixels; then everything; then from all pixels.

    Args:
        start: First guess, shape (23,).
        ink: From `printed`.
        pixels: Place x, y and grey value, shape (n, 3).
        half_px: Half diagonal of the marker, pixels.
        most: How many numbers to fit: 23, or 18 without bows.

    Returns:
        The fit, shape (23,), its covariance, shape (most, most), the noise (grey values) and how
        far the picture moved in the last round (px), infinite where there is no solution.
    """
    fit, covariance = start.copy(), np.zeros((most, most))
    every = max(1, len(pixels) // _COARSE)
    noise = _FIRST_NOISE
    for stage in range(3):
        count = SLOPES if stage == 0 else most
        stride = 1 if stage == 2 else every
        for _ in range(_MOST_ROUNDS):
            N, g, variance, residuals = _normal(fit, ink, pixels, stride, noise, count)
            noise = max(np.median(residuals) / 0.6745, _LEAST_NOISE)
            if stage > 0:
                _add_priors(N, g, fit, noise)
            L, scale = np.zeros((count, count)), np.ones(count)
            if not _factor(N, L, scale):
                return fit, covariance, noise, np.inf
            step = _solved(L, scale, g)
            moved_px = _shorten(fit, step, half_px)
            fit[:count] += step
            _limited(fit, half_px)
            if moved_px < (_SETTLED_PX if stage == 2 else _NEARLY_PX):
                break
    variance = max(variance, _LEAST_NOISE**2) * len(pixels) / max(len(pixels) - most, 1)
    return fit, variance * _inverse(L, scale), noise, moved_px


@kernel
def _inverse(L: Array, scale: Array) -> Array:
    """Return the inverse of the matrix that has been factored."""
    n = len(scale)
    inverse = np.empty((n, n))
    unit = np.zeros(n)
    for k in range(n):
        unit[:] = 0.0
        unit[k] = 1.0
        inverse[:, k] = _solved(L, scale, unit)
    return inverse
