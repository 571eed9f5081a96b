"""Maximum likelihood: Levenberg and Marquardt's method over camera, poses and, if free, shape."""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.bundle import Bundle, Freedom, errors_in_sd, linearise
from tagmetry.calibrate.normal import (
    Normal,
    eliminate_poses,
    normal_equations,
    pose_changes,
)
from tagmetry.calibrate.sightings import Sightings
from tagmetry.geometry import Array

_SETTLED = 1e-10  # of the cost; the error then is within 1e-5 standard deviations of the least
_LARGEST_DAMPING = 1e10


@dataclass(frozen=True, eq=False)
class Solution:
    """The least weighted sum of squared errors that was reached.

    Attributes:
        bundle: Where.
        cost: The sum, with the prior on the shape; infinite where a corner does not project.
    """

    bundle: Bundle
    cost: float


def solve(start: Bundle, seen: Sightings, freedom: Freedom, max_iterations: int = 100) -> Solution:
    """Return the best fit near a start.

    Args:
        start: Where to begin; every corner that counts must project.
        seen: What the views show.
        freedom: What may change.
        max_iterations: Steps, those that fail included.
    """
    now = Solution(start, _cost(start, seen, freedom))
    damping, normal = 1e-3, None
    for _ in range(max_iterations):
        if not np.isfinite(now.cost) or damping > _LARGEST_DAMPING:
            break
        normal = normal or _normal(now.bundle, seen, freedom)
        tried = _step(now.bundle, normal.damped(damping), seen, freedom)
        gain = now.cost - tried.cost
        if gain < 0 or not np.isfinite(tried.cost):
            damping *= 10
            continue
        now, damping, normal = tried, max(damping / 10, 1e-12), None
        if gain <= _SETTLED * tried.cost + 1e-15 * seen.corner_count:
            break
    return now


def _step(bundle: Bundle, normal: Normal, seen: Sightings, freedom: Freedom) -> Solution:
    try:
        information, gradient = eliminate_poses(normal)
        shared = np.asarray(np.linalg.solve(information, gradient), dtype=np.float64)
        by_poses = pose_changes(normal, shared)
    except np.linalg.LinAlgError:
        return Solution(bundle, np.inf)
    by_points = shared[freedom.count :].reshape(-1, 3)
    if freedom.shape_sd_m is None:
        by_points = np.zeros_like(bundle.p_board)
    moved = bundle.moved(freedom.basis @ shared[: freedom.count], by_poses, by_points)
    return Solution(moved, _cost(moved, seen, freedom))


def _normal(bundle: Bundle, seen: Sightings, freedom: Freedom) -> Normal:
    """Return the normal equations with the prior on the shape."""
    normal = normal_equations(linearise(bundle, seen, freedom), freedom)
    if freedom.shape_sd_m is None:
        return normal
    information, pull = shape_prior(bundle, seen, freedom.shape_sd_m)
    none = np.zeros(freedom.count)
    return normal.with_prior(np.append(none, information), np.append(none, pull))


def shape_prior(bundle: Bundle, seen: Sightings, sd_m: Array) -> tuple[Array, Array]:
    """Return the information (3k,) and pull (3k,) of the maker's places on the points."""
    information = np.broadcast_to(sd_m**-2.0, seen.p_board.shape)
    return information.ravel(), (information * (seen.p_board - bundle.p_board)).ravel()


def _cost(bundle: Bundle, seen: Sightings, freedom: Freedom) -> float:
    if not bundle.is_possible:
        return np.inf
    with np.errstate(over="ignore", invalid="ignore"):
        cost = (errors_in_sd(bundle, seen) ** 2).sum()
    if freedom.shape_sd_m is not None:
        cost += (((bundle.p_board - seen.p_board) / freedom.shape_sd_m) ** 2).sum()
    return float(cost) if np.isfinite(cost) else np.inf
