"""Corners that do not fit: found with a soft loss, then left out.

First every corner pulls with at most a bounded force (Huber's loss, by reweighting), so that the
fit settles on what most corners say. Then corners farther off than some standard deviations are
dropped and the rest is fitted by plain least squares, which has a plain covariance; both repeat
until the same corners stay. A corner that fits again comes back.

Reference: P. Huber, Robust Estimation of a Location Parameter, 1964.
"""

import numpy as np

from tagmetry.calibrate.bundle import Bundle, Freedom, errors_in_sd, errors_px
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.solve import Solution, solve
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

SIGMAS = 4.0  # a 2-D normal error is longer once in 3 000 corners
_SOFT_SIGMAS = 2.0
_SOFT_ROUNDS = 10
_DROP_ROUNDS = 10
_MEDIAN_OF_RAYLEIGH = 1.1774  # length of a 2-D normal error, in standard deviations of one axis


def solve_robustly(start: Bundle, seen: Sightings, freedom: Freedom) -> tuple[Solution, BoolArray]:
    """Return the best fit of the corners that fit, and which these are, shape (n, k)."""
    solution = settle_softly(start, seen, freedom)
    kept = fitting(solution.bundle, seen)
    for _ in range(_DROP_ROUNDS):
        solution = solve(solution.bundle, seen.weighted(kept), freedom)
        before, kept = kept, fitting(solution.bundle, seen)
        if (kept == before).all():
            break
    return solution, before


def fitting(bundle: Bundle, seen: Sightings, sigmas: float = SIGMAS) -> BoolArray:
    """Return which corners lie within some robust standard deviations, shape (n, k)."""
    lengths = lengths_in_sd(bundle, seen)
    return np.asarray(seen.used & (lengths <= sigmas * robust_scale(lengths, seen)))


def settle_softly(
    start: Bundle, seen: Sightings, freedom: Freedom, rounds: int = _SOFT_ROUNDS
) -> Solution:
    """Return a fit in which no corner pulls harder than the limit.

    Corners that do not project at first (beyond the fold of a lens that is not right yet) wait
    until they do.
    """
    solution = Solution(start, np.inf)
    for _ in range(rounds):
        lengths = lengths_in_sd(solution.bundle, seen)
        limit = _SOFT_SIGMAS * robust_scale(lengths, seen)
        pulls = np.nan_to_num(limit / np.maximum(lengths, limit))
        before = solution.bundle
        solution = solve(before, seen.weighted(pulls), freedom, max_iterations=5)
        change = np.abs(errors_px(before, seen) - errors_px(solution.bundle, seen)).max()
        if change < 1e-2 * limit / np.sqrt(seen.weights.max()):
            break
    return solution


def lengths_in_sd(bundle: Bundle, seen: Sightings) -> Array:
    """Return how far corners are off in units of their own sd, (n, k); NaN: not projected."""
    return np.asarray(np.linalg.norm(errors_in_sd(bundle, seen), axis=-1))


def robust_scale(lengths: Array, seen: Sightings) -> float:
    """Return the robust standard deviation along an axis, in units of the corners' own."""
    known = lengths[seen.used & np.isfinite(lengths)]
    if not known.size:
        return np.inf
    return max(float(np.median(known)) / _MEDIAN_OF_RAYLEIGH, 1e-9)
