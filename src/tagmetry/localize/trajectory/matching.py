"""Two trajectories at the same times: the true one is interpolated at the other's times.

Positions go straight and turns evenly from one true pose to the next. Where a gap between two is
too wide, nothing is known in it, and what was estimated there is passed over.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Slerp

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray
from tagmetry.localize.trajectory.trajectory import Trajectory

_SAME_S = 1e-6  # from a true pose that needs no other to be known


@dataclass(frozen=True, eq=False)
class Matched:
    """Two trajectories with the same times.

    Attributes:
        estimated: What is judged.
        true: What it is judged by.
        unmatched: How many of the estimated poses have no true one.
    """

    estimated: Trajectory
    true: Trajectory
    unmatched: int = 0


def matched(estimated: Trajectory, true: Trajectory, gap_s: float = 0.1) -> Matched:
    """Return the estimated poses whose true ones are known, and those.

    Args:
        estimated: What is judged.
        true: What it is judged by.
        gap_s: Widest gap between two true poses in which they are interpolated.

    Raises:
        InputError: They have no time in common; the text says from when to when each is.
    """
    if not 0 <= gap_s < np.inf:
        raise InputError(f"gap_s must be finite and not negative, got {gap_s}")
    known = _is_known(estimated.times_s, true.times_s, gap_s)
    if not known.any():
        raise InputError(
            f"no pose has a true one: the first trajectory is from {_span(estimated)}, the second "
            f"from {_span(true)}, and is interpolated over gaps of up to {gap_s:g} s"
        )
    judged = estimated.picked(known)
    return Matched(judged, _interpolated(true, judged.times_s), int((~known).sum()))


def _is_known(times_s: Array, true_s: Array, gap_s: float) -> BoolArray:
    after = np.searchsorted(true_s, times_s).clip(0, len(true_s) - 1)
    before = (after - 1).clip(0)
    is_between = (true_s[before] <= times_s) & (times_s <= true_s[after])
    nearest_s = np.minimum(np.abs(true_s[before] - times_s), np.abs(true_s[after] - times_s))
    narrow = true_s[after] - true_s[before] <= gap_s
    return np.asarray((is_between & narrow) | (nearest_s <= _SAME_S))


def _interpolated(true: Trajectory, times_s: Array) -> Trajectory:
    if len(true.times_s) == 1:
        return Trajectory(times_s, true.poses[np.zeros(len(times_s), dtype=np.int64)])
    inside_s = times_s.clip(true.times_s[0], true.times_s[-1])
    places = [np.interp(inside_s, true.times_s, one) for one in true.positions_m.T]
    turns = Slerp(true.times_s, true.poses.rotation)(inside_s)
    return Trajectory(times_s, RigidTransform.from_components(np.stack(places, axis=1), turns))


def _span(one: Trajectory) -> str:
    return f"{one.times_s[0]:.3f} to {one.times_s[-1]:.3f} s"
