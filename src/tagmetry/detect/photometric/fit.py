"""Gauss and Newton: the numbers of the model that explain the pixels best, and their covariance."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.evaluate import evaluate
from tagmetry.detect.photometric.kernel import Narrow, kernel, step
from tagmetry.detect.photometric.model import BLACK, BLUR, EXPONENT, FALL, SLOPES, cell_px
from tagmetry.detect.photometric.noise import LEAST_NOISE, count_sizes, new_counts, noise_of
from tagmetry.detect.photometric.normal import add_products, factor, solve
from tagmetry.detect.photometric.values import narrowed
from tagmetry.detect.photometric.view import View
from tagmetry.geometry import Array

_JUDGED = 256  # pixels, about, whose residuals tell the noise
_VARIED = 400  # pixels, at least, whose residuals tell the variance
_PRIOR_EXPONENT = 0.7  # of its logarithm
_PRIOR_BLUR = 1.0  # of its variances, as a share
_PRIOR_SLOPE = 0.3  # of light, across half a diagonal
_PRIOR_FALL = 0.01  # the same, as a share
_MOST_MOVE_PX = 1.5
_MOST_ROUNDS = 6
_BLUR_KEPT = 0.15  # a change of its variance that does not matter any more, as a share
_OF_WEIGHTS = 1.228  # (E w / E (w r)')^2 of Cauchy's weights on Gaussian noise
EXPONENTS = (-0.7, 1.4)  # of their logarithm
_BLUR_PX2 = (0.1, 16.0)


@kernel
def fit_pixels(
    view: View,
    fit: Array,
    pixel_count: int,
    edges: int,
    count: int,
    settled_px: float,
    noise: float,
    every: int = 1,
) -> tuple[float, float, Array, Array]:
    """Improve the first `count` numbers of a fit until a round changes place and blur little.

    Args:
        view: Whose pixels have been gathered, and their windows set.
        fit: First guess, changed, shape (24,).
        pixel_count: How many pixels there are.
        edges: How many edges of each direction a pixel sees.
        count: How many numbers to fit: 10, place and levels; 18, all but
            what follows; 19, how light falls off as well; 24, and bows.
        settled_px: What little is, of the place.
        noise: First guess, grey values.
        every: One block of so many is looked at.

    Returns:
        The noise; how far the picture moved in the last round (px), infinite where there is no
        solution; the factor of the normal matrix and its scale, see `factor`.
    """
    sums = np.empty((row.MOST_NUMBERS, row.MOST_NUMBERS))
    L, scale, moved_px = np.zeros((count, count)), np.ones(count), np.inf
    for _ in range(_MOST_ROUNDS):
        noise = _sum_up(view, fit, pixel_count, edges, noise, count, every, sums)
        if count > SLOPES:
            _add_priors(sums, fit, noise)
        if not factor(sums, L, scale):
            return noise, np.inf, L, scale
        step = solve(L, scale, sums)
        moved_px = _shorten(fit, step, view.frame[2])
        fit[:count] += step
        _limited(fit, view.frame[2])
        if moved_px < settled_px and _keeps_blur(fit, step):
            break
    return noise, moved_px, L, scale


@step
def _sum_up(
    view: View,
    fit: Array,
    pixel_count: int,
    edges: int,
    noise: float,
    count: int,
    every: int,
    sums: Array,
) -> float:
    """Write the sums of products of residuals and derivatives; return the noise."""
    room, equations, counts = view.room, view.room[row.EQUATIONS :], new_counts()
    narrow, lanes = narrowed(fit, view.frame[2]), 0
    sums[:] = 0.0
    for first in range(0, pixel_count, every * row.BLOCK):
        _read(room, view.pixels, first, edges)
        evaluate(room, equations[lanes:], narrow, edges, noise, count)
        own = min(row.BLOCK, pixel_count - first)
        count_sizes(room[row.SIZE :], own, 1 + pixel_count // (every * _JUDGED), counts)
        lanes += row.BLOCK
        if lanes == row.LANES or first + every * row.BLOCK >= pixel_count:
            add_products(equations, lanes, sums, count)
            lanes = 0
    return noise_of(counts)


@step
def _read(room: Narrow, pixels: Narrow, first: int, edges: int) -> None:
    """Write what is known of a block's pixels into the room."""
    pixel = pixels[first // row.BLOCK]
    for k in range(row.CHANGES + (edges + 1) ** 2 * row.BLOCK):
        room[k] = pixel[k]


@kernel
def variance_beside_edges(
    view: View, fit: Array, pixel_count: int, edges: int, noise: float
) -> float:
    """Return the variance of residuals where the picture has edges; arguments as above.

    There it holds what the model does not describe too, and it is what moves the fit.
    """
    room, equations, squares, slopes2 = view.room, view.room[row.EQUATIONS :], 0.0, 1e-12
    narrow = narrowed(fit, view.frame[2])
    across, downward = row.J + 2 * row.LANES, row.J + 5 * row.LANES  # by a shift of the picture
    every = 1 + pixel_count // _VARIED
    for first in range(0, pixel_count, every * row.BLOCK):
        _read(room, view.pixels, first, edges)
        evaluate(room, equations, narrow, edges, noise, SLOPES)
        for p in range(row.BLOCK):
            slope2 = equations[across + p] ** 2 + equations[downward + p] ** 2
            squares += slope2 * equations[row.RESIDUAL + p] ** 2
            slopes2 += slope2
    return max(_OF_WEIGHTS * squares / slopes2, LEAST_NOISE**2)


@step
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


@step
def picture_moved_px(fit: Array, step: Array, half_px: float) -> float:
    """Return how far a step moves the picture, px."""
    across = abs(step[0]) + abs(step[1]) + abs(step[2])
    down = abs(step[3]) + abs(step[4]) + abs(step[5])
    return float(cell_px(fit, half_px) * max(across, down))


@step
def _shorten(fit: Array, step: Array, half_px: float) -> float:
    """Keep a step where the model may be taken as linear; return how far it moves the picture."""
    moved_px = picture_moved_px(fit, step, half_px)
    step[:8] /= max(1.0, moved_px / _MOST_MOVE_PX)
    if len(step) > BLUR:
        step[EXPONENT] = min(max(step[EXPONENT], -0.4), 0.4)
        most = 0.5 * (fit[BLUR] + fit[BLUR + 2])
        largest = max(abs(step[BLUR]), abs(step[BLUR + 1]), abs(step[BLUR + 2]))
        step[BLUR : BLUR + 3] /= max(1.0, 2 * largest / most)
    return moved_px


@step
def _keeps_blur(fit: Array, step: Array) -> bool:
    """Say whether a step left the blur about as it was."""
    if len(step) <= BLUR:
        return True
    return bool(abs(step[BLUR]) + abs(step[BLUR + 2]) < _BLUR_KEPT * (fit[BLUR] + fit[BLUR + 2]))


@step
def _add_priors(sums: Array, fit: Array, noise: float) -> None:
    """Add what is known beforehand: exponents near 1, blur alike in all directions, even light."""
    _add_prior(sums, EXPONENT, noise / _PRIOR_EXPONENT, fit[EXPONENT])
    mean = 0.5 * (fit[BLUR] + fit[BLUR + 2])
    for k in range(3):
        off = fit[BLUR + k] - (0.0 if k == 1 else mean)
        _add_prior(sums, BLUR + k, noise / (_PRIOR_BLUR * mean), off)
    for k in range(SLOPES, EXPONENT):
        _add_prior(sums, k, noise / _PRIOR_SLOPE, fit[k])
    _add_prior(sums, FALL, noise / _PRIOR_FALL, fit[FALL])  # not read unless it is fitted


@step
def _add_prior(sums: Array, k: int, root: float, off: float) -> None:
    """Add that number k is `off` from where it is expected, with the root of a weight."""
    sums[k + 1, k + 1] += root**2
    sums[k + 1, 0] -= root**2 * off
