"""Hold-out error without solving again: what the others alone would have said, to first order.

At the solution the gradients of all views cancel. Without a group of views the shared numbers move
by one step of Gauss and Newton on what the other views know (S and g with all poses eliminated,
see `normal`):

    shared change = (S - S_group)^-1 (g - g_group)

Then the group's own poses are fitted, and that is solved in full. `hold_out` solves everything
again and takes as many times longer as there are groups and steps; tests hold the two together.

Reference: R. Cook, Detection of Influential Observation in Linear Regression, 1977.
"""

import numpy as np

from tagmetry.calibrate.bundle import Bundle, Linear, linearise
from tagmetry.calibrate.fit import Fit
from tagmetry.calibrate.hold_out import left_out_groups, pooled_px, squares_by_own_pose_px2
from tagmetry.calibrate.normal import eliminate_poses, normal_equations
from tagmetry.calibrate.solve import shape_prior
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray


def quick_hold_out_px(fit: Fit, most_rounds: int, enough: int) -> float:
    """Return about what `hold_out_px` returns; infinite where the others decide nothing."""
    linear = linearise(fit.bundle, fit.seen, fit.freedom)
    information, gradient = information_of_all(fit, linear)
    squares = np.full(len(fit.seen), np.nan)
    for group in left_out_groups(len(fit.seen), most_rounds, enough):
        own, own_gradient = _of_views(fit, linear, group)
        moved = _moved(fit, information - own, gradient - own_gradient)
        squares[group] = squares_by_own_pose_px2(moved, fit, group)
    return pooled_px(squares, fit)


def _of_views(fit: Fit, linear: Linear, views: IntArray) -> tuple[Array, Array]:
    """Return information (m, m) and gradient (m,) that some views have of the shared numbers."""
    return eliminate_poses(normal_equations(linear.only(views), fit.freedom))


def information_of_all(fit: Fit, linear: Linear) -> tuple[Array, Array]:
    """Return what all views know of the shared numbers, with what is believed of the shape.

    Returns:
        Information (m, m) and gradient (m,); at a solution the gradient is zero.
    """
    information, gradient = _of_views(fit, linear, np.arange(len(fit.seen)))
    if fit.freedom.shape_sd_m is None:
        return information, gradient
    known, pull = shape_prior(fit.bundle, fit.seen, fit.freedom.shape_sd_m)
    none = np.zeros(fit.freedom.count)
    return information + np.diag(np.append(none, known)), gradient + np.append(none, pull)


def _moved(fit: Fit, information: Array, gradient: Array) -> Bundle:
    """Return the camera and the board after the step, the poses where they were."""
    size = np.sqrt(np.maximum(np.diag(information), 1e-300))
    try:
        step = np.linalg.solve(information / np.outer(size, size), gradient / size) / size
    except np.linalg.LinAlgError:
        step = np.full(len(size), np.nan)
    points = np.zeros_like(fit.bundle.p_board)
    if fit.freedom.shape_sd_m is not None:
        points = step[fit.freedom.count :].reshape(-1, 3)
    still = np.zeros((len(fit.seen), 6))
    return fit.bundle.moved(fit.freedom.basis @ step[: fit.freedom.count], still, points)
