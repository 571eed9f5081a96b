"""How far a trajectory is from the true one: absolute and relative error.

    absolute: E_i = T_true_i^-1 T_i, after an alignment of the worlds
    relative: E_i = (T_true_i^-1 T_true_j)^-1 (T_i^-1 T_j),  j later than i by a step

The relative error needs no alignment and says how fast errors grow. Of each E its shift and its
angle are told.

Reference: Sturm et al. 2012, A benchmark for the evaluation of RGB-D SLAM systems, section IV.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import IntArray
from tagmetry.localize.trajectory.alignment import Alignment, AlignmentName, alignment
from tagmetry.localize.trajectory.matching import Matched, matched
from tagmetry.localize.trajectory.trajectory import Trajectory


@dataclass(frozen=True)
class Spread:
    """Errors in a few numbers, in the errors' own unit; NaN where there are none.

    Attributes:
        rms: Root of the mean square.
        mean: Their mean.
        median: Their median.
        largest: The largest.
    """

    rms: float
    mean: float
    median: float
    largest: float

    @classmethod
    def of(cls, errors: Array) -> "Spread":
        """Return those of errors, shape (n,), none of them negative."""
        if not len(errors):
            return cls(np.nan, np.nan, np.nan, np.nan)
        rms = float(np.sqrt((errors**2).mean()))
        return cls(rms, float(errors.mean()), float(np.median(errors)), float(errors.max()))


@dataclass(frozen=True, eq=False)
class Comparison:
    """How far a trajectory is from the true one.

    Attributes:
        both: The two at the same times; the estimated one is aligned.
        by: What it was aligned by.
        absolute_m: Shifts of the n poses, shape (n,).
        absolute_rad: Their angles, shape (n,).
        relative_m: Shifts over the m steps, shape (m,).
        relative_rad: Their angles, shape (m,).
        step_s: How long a step is; 0 for one from each pose to the next.
    """

    both: Matched
    by: Alignment
    absolute_m: Array
    absolute_rad: Array
    relative_m: Array
    relative_rad: Array
    step_s: float


def compare(
    estimated: Trajectory,
    true: Trajectory,
    *,
    align: AlignmentName = "none",
    gap_s: float = 0.1,
    step_s: float = 0.0,
) -> Comparison:
    """Return how far a trajectory is from the true one.

    Args:
        estimated: What is judged.
        true: What it is judged by; interpolated at the other's times.
        align: `none` for poses of one thing in one world, as those in a marker map are; `path`
            turns and shifts the estimated world so that the ways lie on one another; `rig` does so
            for two things that are fixed to each other.
        gap_s: Widest gap between two true poses in which they are interpolated.
        step_s: Over which time the relative error is taken; 0 from each pose to the next.

    Raises:
        InputError: No common time, or a way that does not tell the alignment.
    """
    if not 0 <= step_s < np.inf:
        raise InputError(f"step_s must be finite and not negative, got {step_s}")
    both = matched(estimated, true, gap_s)
    by = alignment(both, align)
    both = Matched(by.of(both.estimated), both.true, both.unmatched)
    own, right = both.estimated.poses, both.true.poses
    first, last = _steps(both.true.times_s, step_s)
    step, right_step = own[first].inv() * own[last], right[first].inv() * right[last]
    absolute, relative = _sizes(right.inv() * own), _sizes(right_step.inv() * step)
    return Comparison(both, by, *absolute, *relative, step_s)


def _steps(times_s: Array, step_s: float) -> tuple[IntArray, IntArray]:
    """Return the numbers of the poses where steps begin and end: the first that is late enough."""
    if step_s == 0:
        return np.arange(len(times_s) - 1), np.arange(1, len(times_s))
    last = np.searchsorted(times_s, times_s + step_s * (1 - 1e-9))
    ends = last < len(times_s)
    if not ends.any():
        raise InputError(
            f"no two poses are {step_s:g} s apart; they are {times_s[-1] - times_s[0]:g} s from "
            "the first to the last: take a shorter step_s"
        )
    return np.flatnonzero(ends), last[ends]


def _sizes(errors: RigidTransform) -> tuple[Array, Array]:
    """Return shifts in metres and angles in radians."""
    return (
        np.linalg.norm(np.asarray(errors.translation), axis=-1),
        np.asarray(errors.rotation.magnitude()),
    )
