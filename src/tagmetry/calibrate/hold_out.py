"""How well a camera shows views that it was not solved from.

Errors count by what their corners tell, as they do in the fit: a mean over all corners alike is
that of the worst of them, and says little of the camera.
"""

from dataclasses import replace

import numpy as np

from tagmetry.calibrate.bundle import Bundle, Freedom, errors_in_sd
from tagmetry.calibrate.fit import Fit
from tagmetry.calibrate.solve import solve
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray

_MOST_ROUNDS = 20
_ALL = 1_000_000_000  # views
_MOST_STEPS = 6  # from the solution of all views; more only go along valleys


def hold_out_px(fit: Fit, most_rounds: int = _MOST_ROUNDS, enough: int = _ALL) -> float:
    """Return the root of the mean squared 2-D error over left-out views, weighted.

    Each view is left out once, alone or, with more views than rounds, in interleaved groups, until
    enough have been. The camera (and the board's shape) is solved from the others; then only the
    view's own pose is fitted, to all of its corners. Infinite where the others lead to no camera
    that shows it.
    """
    squares = np.full(len(fit.seen), np.nan)
    for group in left_out_groups(len(fit.seen), most_rounds, enough):
        squares[group] = _squares_without(fit, group)
    return pooled_px(squares, fit)


def left_out_groups(views: int, most_rounds: int, enough: int) -> list[IntArray]:
    """Return groups of views to leave out, no more groups than it takes for enough views."""
    rounds = min(views, most_rounds)
    tried = min(rounds, -(-enough * rounds // views))
    return [np.arange(first, views, rounds) for first in range(tried)]


def pooled_px(squares_px2: Array, fit: Fit) -> float:
    """Return the root of the weighted mean of views' squares (n,), NaN where not asked."""
    asked = ~np.isnan(squares_px2)
    weights = fit.seen.weights.sum(axis=1)[asked]
    return float(np.sqrt((squares_px2[asked] * weights).sum() / weights.sum()))


def _squares_without(fit: Fit, group: IntArray) -> Array:
    rest = np.setdiff1d(np.arange(len(fit.seen)), group)
    solved = solve(fit.bundle.only(rest), fit.seen.only(rest), fit.freedom, _MOST_STEPS).bundle
    return squares_by_own_pose_px2(solved, fit, group)


def squares_by_own_pose_px2(solved: Bundle, fit: Fit, group: IntArray) -> Array:
    """Return each view's mean squared 2-D error by a camera and board, its own pose fitted.

    Args:
        solved: The camera and the board.
        fit: Has the views, and poses to start from.
        group: Which views.

    Returns:
        Shape (views of the group,), px^2; infinite where the camera does not show the view.
    """
    if not solved.is_possible:
        return np.full(len(group), np.inf)
    left_out, seen = fit.bundle.only(group), fit.seen.only(group)
    start = replace(left_out, intrinsics=solved.intrinsics, p_board=solved.p_board)
    posed = solve(start, seen, Freedom(fit.freedom.basis[:, :0]), _MOST_STEPS).bundle
    squares = (errors_in_sd(posed, seen) ** 2).sum(axis=(1, 2)) / seen.weights.sum(axis=1)
    return np.asarray(np.nan_to_num(squares, nan=np.inf))
