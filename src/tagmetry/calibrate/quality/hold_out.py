"""How well a camera shows views that it was not solved from.

Each view is left out once, alone for up to 20 views and in 20 interleaved groups for more, and the
camera solved from the others. Then the view's own pose is fitted to all of its corners, and its
errors are counted ("all"); or it is fitted to every second corner, and the errors of the others
are counted, which tells of the camera alone ("alternate").
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.bundle import Bundle, Freedom, errors_px
from tagmetry.calibrate.quality.solved import Solved
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.solve import solve
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray

_LEAST_VIEWS = 4
_MOST_ROUNDS = 20
_LEAST_CORNERS = 4  # of a board, for a pose


@dataclass(frozen=True, eq=False)
class HoldOut:
    """Errors on left-out views, root of the mean squared 2-D error; infinite without a camera.

    Attributes:
        view_px: Of each view, its pose fitted to all corners, shape (views,).
        view_alternate_px: Of each view, on the corners its pose was not fitted to; NaN for views of
            fewer than eight corners.
        corners: How many corners of each view count, shape (views,).
    """

    view_px: Array
    view_alternate_px: Array
    corners: IntArray

    @property
    def rms_px(self) -> float:
        """Over all corners of all views."""
        return _over_views(self.view_px, self.corners)

    @property
    def alternate_rms_px(self) -> float:
        """The same of corners that poses were not fitted to."""
        known = ~np.isnan(self.view_alternate_px)
        return _over_views(self.view_alternate_px[known], self.corners[known])


def hold_out(calibration: Calibration) -> HoldOut:
    """Return the errors on each view of a camera solved without it.

    Raises:
        InputError: Fewer than four views.
    """
    count = len(calibration.views)
    if count < _LEAST_VIEWS:
        raise InputError(f"expected at least {_LEAST_VIEWS} views to leave one out, got {count}")
    solved = Solved.of(calibration)
    errors_px = np.zeros((count, 2))
    rounds = min(count, _MOST_ROUNDS)
    for first in range(rounds):
        group = np.arange(first, count, rounds)
        without = _without(solved, group)
        errors_px[group] = [_errors_px(without, solved, int(view)) for view in group]
    return HoldOut(errors_px[:, 0], errors_px[:, 1], solved.seen.used.sum(axis=1))


def _without(solved: Solved, group: IntArray) -> Bundle:
    """Return the solution without some views, started from the one with them."""
    rest = np.setdiff1d(np.arange(len(solved.seen)), group)
    return solve(solved.bundle.only(rest), solved.seen.only(rest), solved.freedom).bundle


def _errors_px(without: Bundle, solved: Solved, view: int) -> tuple[float, float]:
    """Return the errors of a left-out view: all, and alternate corners."""
    own = solved.seen.only(np.array([view]))
    start = replace(
        solved.bundle.only(np.array([view])),
        intrinsics=without.intrinsics,
        p_board=without.p_board,
    )
    every = _rms_px(_posed(start, own), own)
    second = _every_second(own)
    if own.corner_count < 2 * _LEAST_CORNERS:
        return every, np.nan
    posed = _posed(start, own.weighted(second))
    return every, _rms_px(posed, own.weighted(1.0 - second))


def _every_second(seen: Sightings) -> Array:
    """Return 1 for every second corner that counts, else 0, shape (1, k)."""
    return np.where(seen.used, (np.cumsum(seen.used, axis=1) - 1) % 2, 0).astype(np.float64)


def _posed(start: Bundle, seen: Sightings) -> Bundle:
    """Return a bundle with its poses fitted, the camera as it is."""
    return solve(start, seen, Freedom(np.zeros((len(start.intrinsics), 0)))).bundle


def _rms_px(bundle: Bundle, seen: Sightings) -> float:
    error = (errors_px(bundle, seen) ** 2).sum() / seen.corner_count
    return float(np.sqrt(np.nan_to_num(error, nan=np.inf)))


def _over_views(each_px: Array, corners: IntArray) -> float:
    return float(np.sqrt((each_px**2 * corners).sum() / corners.sum()))
