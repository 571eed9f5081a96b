"""The world of one trajectory in that of another, and one thing on the other.

`path` has both follow the same point in two worlds:

    minimise sum |p_true_i - (R p_i + t)|^2,    without a scale: a metre is a metre

`rig` has them follow two things that are fixed to each other, such as a camera and the markers of
motion capture on it, T_true_i = A T_i X. For the motions between two times, B of the estimated and
C of the true one, it says X C = B X; A is then the mean of T_true_i X^-1 T_i^-1.

Reference: Horn 1987; Umeyama 1991, equations 40 to 42 with c = 1. Park and Martin 1994 for X.
"""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize.trajectory.matching import Matched
from tagmetry.localize.trajectory.trajectory import Trajectory

AlignmentName = Literal["none", "path", "rig"]

_STRAIGHT = 1e-3  # a way's width by its length, below which a turn about it is not told
_STEADY = 1e-3  # the same for the axes about which a thing turns
_MOST = 64  # poses whose motions are taken, of a longer trajectory spread over it


@dataclass(frozen=True, eq=False)
class Alignment:
    """How an estimated trajectory becomes comparable with the true one.

    Attributes:
        T_true_estimated: From the world of the estimated poses to that of the true ones.
        T_thing_part: From what the true poses are of to what the estimated ones are of: the
            place of the first on the second.
    """

    T_true_estimated: RigidTransform = field(default_factory=RigidTransform.identity)
    T_thing_part: RigidTransform = field(default_factory=RigidTransform.identity)

    def of(self, estimated: Trajectory) -> Trajectory:
        """Return the estimated poses as those of the true one's thing in its world."""
        return estimated.moved(self.T_true_estimated).of_part(self.T_thing_part)


def alignment(both: Matched, name: AlignmentName) -> Alignment:
    """Return what aligns a trajectory with the true one.

    Raises:
        InputError: The way is too short or too straight, or the thing turns too little, to tell.
    """
    if name == "path":
        return Alignment(_by_path(both.estimated.positions_m, both.true.positions_m))
    if name == "rig":
        return _by_rig(both)
    if name == "none":
        return Alignment()
    raise InputError(f"align must be none, path or rig, got {name!r}")


def _by_path(own_m: Array, true_m: Array) -> RigidTransform:
    middle, true_middle = own_m.mean(axis=0), true_m.mean(axis=0)
    mixed = (true_m - true_middle).T @ (own_m - middle)
    U, widths2, Vt = np.linalg.svd(mixed)
    if len(true_m) < 3 or not widths2[1] > _STRAIGHT**2 * widths2[0]:
        raise InputError(
            f"the way is too straight to align the worlds by: {len(true_m)} common poses nearly in "
            f"a line; compare without an alignment"
        )
    mirror = np.diag([1.0, 1.0, np.linalg.det(U) * np.linalg.det(Vt)])
    R = Rotation.from_matrix(U @ mirror @ Vt)
    return RigidTransform.from_components(true_middle - R.apply(middle), R)


def _by_rig(both: Matched) -> Alignment:
    count = len(both.true.times_s)
    chosen = np.unique(np.linspace(0, count - 1, min(count, _MOST)).round().astype(np.int64))
    first, second = (chosen[one] for one in np.triu_indices(len(chosen), 1))
    own, true = both.estimated.poses, both.true.poses
    B, C = own[first].inv() * own[second], true[first].inv() * true[second]
    X = _offset(B, C)
    each = true * X.inv() * own.inv()
    places = np.asarray(each.translation).mean(axis=0)
    return Alignment(RigidTransform.from_components(places, each.rotation.mean()), X)


def _offset(B: RigidTransform, C: RigidTransform) -> RigidTransform:
    """Return X of X C = B X: its turn from the axes of the motions, then its shift."""
    own, true = B.rotation.as_rotvec(), C.rotation.as_rotvec()
    axes = np.linalg.svd(own.T @ true, compute_uv=False)
    if len(own) < 3 or not axes[1] > _STEADY**2 * axes[0] or axes[1] < _STEADY**2:
        raise InputError(
            "the thing turns too little, or about one axis only, to tell how one thing sits on the "
            "other; align by path, or not at all"
        )
    R, _ = Rotation.align_vectors(own, true)
    left = (B.rotation.as_matrix() - np.eye(3)).reshape(-1, 3)
    right = (R.apply(C.translation) - np.asarray(B.translation)).ravel()
    return RigidTransform.from_components(np.linalg.lstsq(left, right)[0], R)
