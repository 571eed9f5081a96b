"""Views to the best camera of one kind: start, refine, drop what does not fit."""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.belief import shape_belief_m
from tagmetry.calibrate.bundle import Bundle, Freedom
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.robust import lengths_in_sd, robust_scale, settle_softly, solve_robustly
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.solve import solve
from tagmetry.calibrate.start import starts
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_GOOD_ENOUGH = 2.0  # times the error that homographies leave: no other start is tried


@dataclass(frozen=True, eq=False)
class Fit:
    """A solved camera.

    Attributes:
        bundle: Camera, poses and board.
        freedom: What was free.
        seen: The corners that it fits; those that were dropped have no weight.
    """

    bundle: Bundle
    freedom: Freedom
    seen: Sightings

    @property
    def scale(self) -> float:
        """Robust standard deviation of the errors, in units of the corners' own."""
        return robust_scale(lengths_in_sd(self.bundle, self.seen), self.seen)


def fit_flat(seen: Sightings, wanted: Wanted, *, robust: bool) -> Fit:
    """Return the best camera when the board is as its maker says.

    Raises:
        InputError: No camera of this kind shows the board like that.
    """
    return refit(begin(seen, wanted), seen, wanted, robust=robust)


def refit(start: Bundle, seen: Sightings, wanted: Wanted, *, robust: bool, steps: int = 100) -> Fit:
    """Return the best camera near a start of the same or a simpler lens."""
    freedom = Freedom(wanted.basis())
    start = wanted.conform(start, seen.size_px)
    return _solved(start, seen, freedom, robust=robust, steps=steps)


def release_shape(flat: Fit, seen: Sightings, *, robust: bool) -> Fit:
    """Return the best camera when the board's points may leave the maker's places.

    How far is a matter of belief: `shape_belief_m`. It also settles what no picture tells: the
    board's own frame and scale. The corners' sd is set to what the flat fit left, so that belief
    and measurement weigh as they should.
    """
    freedom = replace(flat.freedom, shape_sd_m=shape_belief_m(seen.p_board))
    seen = seen.weighted(np.array(flat.scale**-2.0))
    return _solved(flat.bundle, seen, freedom, robust=robust)


def begin(seen: Sightings, wanted: Wanted) -> Bundle:
    """Return the best of several starts after a short refinement.

    Lenses with more than five coefficients start from five: the others need a good camera.
    """
    guesses, homography_error_px = starts(seen, wanted.kind, min(wanted.coefficients, 5))
    basis = wanted.basis()
    width = 4 + min(wanted.coefficients, 5)
    basis = basis[:width, np.abs(basis[:width]).any(axis=0)]
    tried: list[tuple[float, Bundle]] = []
    for guess in guesses:
        start = _held(guess, wanted, seen.size_px)
        bundle = settle_softly(start, seen, Freedom(basis), rounds=3).bundle
        error_px = _median_error_px(bundle, seen)
        if error_px < _GOOD_ENOUGH * homography_error_px:
            return bundle
        tried.append((error_px, bundle))
    best = min(tried, key=lambda pair: pair[0], default=(np.inf, None))
    if best[1] is None or not np.isfinite(best[0]):
        raise InputError(
            "no camera shows the board like that: check the board's rows and columns, and that "
            "the views show it at different tilts"
        )
    return best[1]


def _solved(
    start: Bundle, seen: Sightings, freedom: Freedom, *, robust: bool, steps: int = 100
) -> Fit:
    """Return the best fit near a start, of the corners that fit or of all."""
    if robust:
        solution, kept = solve_robustly(start, seen, freedom)
    else:
        solution = solve(start, seen, freedom, steps)
        if not np.isfinite(solution.cost):  # some corners do not project yet
            settled = settle_softly(start, seen, freedom).bundle
            solution = solve(settled, seen, freedom, steps)
        kept = seen.used
    if not np.isfinite(solution.cost):
        raise InputError(
            "the lens does not reach all corners of the board: check the board's rows and "
            "columns, ask for another lens, or let outliers be dropped"
        )
    return Fit(solution.bundle, freedom, seen.weighted(kept))


def _held(guess: Bundle, wanted: Wanted, size_px: tuple[int, int]) -> Bundle:
    """Return a guess with what is held fixed at its value, its own lens kept."""
    conformed = wanted.conform(guess, size_px).intrinsics
    width = len(guess.intrinsics)
    return replace(guess, intrinsics=conformed[:width])


def _median_error_px(bundle: Bundle, seen: Sightings) -> float:
    errors: Array = np.linalg.norm(seen.corners_px - bundle.predict(), axis=-1)
    used: BoolArray = seen.used
    return float(np.median(np.nan_to_num(errors[used], nan=np.inf)))
