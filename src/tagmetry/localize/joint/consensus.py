"""Which markers agree on a camera pose, and the pose that they agree on, compiled.

From a start, a few steps with weights that fall with a marker's distance, so that a wrong or moved
marker hardly pulls; then exact steps on those markers that agree, until they stay the same. A
marker that does not agree as a whole may without one of its corners: a thing stood before it.
"""

from typing import NamedTuple

import numpy as np

from tagmetry.geometry.arrays import Array, BoolArray, IntArray
from tagmetry.localize.joint.equations import known_system, marginal, products, whiteners
from tagmetry.localize.joint.robust import FAR, distances2_of, lower_median, step
from tagmetry.localize.joint.scene import Scene
from tagmetry.localize.joint.small import add, kernel, turn

GATE = 31.8  # chi2 with 8 degrees of freedom: one good marker in ten thousand is turned away
REST_GATE = 27.9  # the same with 6, for a marker without one of its corners
CORNER_COST = 18.4  # what a dropped corner costs: the same with 2
MARKER_COST = REST_GATE + CORNER_COST  # what a marker that is left out costs
_MEDIAN = 7.34  # median of chi2 with 8 degrees of freedom
_STEPS, _ROUNDS = 12, 6
_SETTLED = 1e-9


class Consensus(NamedTuple):
    """A pose and the markers that agree with it.

    Attributes:
        R: R_world_camera, shape (3, 3).
        t: Shape (3,), metres.
        system: [chi2 g^T; g H] of the markers that agree and of what is known, shape (7, 7).
        distances2: Squared distance of every marker, its map error included, shape (m,).
        agrees: Which markers agree, shape (m,).
        dropped: Which corner of a marker disagrees, -1 for none, shape (m,).
        spread2: By how much the markers' distances exceed their covariance, at least 1.
    """

    R: Array
    t: Array
    system: Array
    distances2: Array
    agrees: BoolArray
    dropped: IntArray
    spread2: float


@kernel
def consensus(scene: Scene, R: Array, t: Array) -> Consensus:
    """Return what the markers agree on near a pose to which the robust steps have led."""
    dropped = np.full(len(scene.noise), -1)
    whole = whiteners(scene, dropped)
    agrees, spread2 = _agreeing(scene, R, t, whole, dropped)
    L = whiteners(scene, dropped)
    for _ in range(_ROUNDS):
        R, t = _fitted(scene, R, t, L, agrees, spread2)
        before, before_dropped = agrees.copy(), dropped.copy()
        agrees, spread2 = _agreeing(scene, R, t, whole, dropped)
        if _is_same(agrees, dropped, before, before_dropped):
            break
        L = whiteners(scene, dropped)
    system = _group_system(scene, R, t, L, agrees, 1.0)
    return Consensus(R, t, system, distances2_of(scene, R, t, L), agrees, dropped, spread2)


@kernel
def _is_same(
    agrees: BoolArray, dropped: IntArray, before: BoolArray, before_dropped: IntArray
) -> bool:
    for m in range(len(agrees)):
        if agrees[m] != before[m] or dropped[m] != before_dropped[m]:
            return False
    return True


@kernel
def _agreeing(
    scene: Scene, R: Array, t: Array, L: Array, dropped: IntArray
) -> tuple[BoolArray, float]:
    """Return which markers agree with a pose and the spread; fill which corners are dropped."""
    distances2 = distances2_of(scene, R, t, L)
    spread2 = max(1.0, lower_median(distances2) / _MEDIAN)
    agrees, count = np.zeros(len(distances2), dtype=np.bool_), 0
    for m in range(len(agrees)):
        dropped[m] = -1
        agrees[m] = distances2[m] <= GATE * spread2
        count += agrees[m]
    if count > 1:  # one marker cannot judge the corners of another
        for m in range(len(agrees)):
            if not agrees[m] and distances2[m] < FAR:
                dropped[m] = _odd_corner(scene, m, R, t, spread2)
                agrees[m] = dropped[m] >= 0
    return agrees, spread2


@kernel
def _odd_corner(scene: Scene, m: int, R: Array, t: Array, spread2: float) -> int:
    """Return the corner without which a marker agrees best, -1 where it does without none."""
    dropped = np.full(len(scene.noise), -1)
    odd, least = -1, REST_GATE * spread2
    for corner in range(4):
        dropped[m] = corner
        rest = distances2_of(scene, R, t, whiteners(scene, dropped))[m]
        if rest <= least:
            odd, least = corner, rest
    return odd


@kernel
def _fitted(
    scene: Scene, R: Array, t: Array, L: Array, agrees: BoolArray, spread2: float
) -> tuple[Array, Array]:
    """Return the pose that fits the agreeing markers best."""
    damping = 1e-6
    system = _group_system(scene, R, t, L, agrees, spread2)
    for _ in range(_STEPS):
        change = step(system, damping)
        tried_R, tried_t = turn(change[3:], R), t + change[:3]
        tried = _group_system(scene, tried_R, tried_t, L, agrees, spread2)
        if tried[0, 0] <= system[0, 0]:
            settled = system[0, 0] - tried[0, 0] < _SETTLED * (1.0 + tried[0, 0])
            R, t, system, damping = tried_R, tried_t, tried, 0.1 * damping
            if settled:
                break
        else:
            damping = max(10.0 * damping, 1e-4)
    return R, t


@kernel
def _group_system(
    scene: Scene, R: Array, t: Array, L: Array, agrees: BoolArray, spread2: float
) -> Array:
    """Return [chi2 g^T; g H] of the agreeing markers; markers of one group err together."""
    P, in_front = products(scene, R, t, L)
    sums = np.zeros((len(scene.anchors), P.shape[1], P.shape[1]))
    total = known_system(scene, R, t)
    for m in range(len(P)):
        if agrees[m]:
            add(P[m], sums[scene.group[m]], 1.0)
            if not in_front[m]:
                total[0, 0] += FAR
    for g in range(len(sums)):
        add(marginal(sums[g]), total, 1.0 / spread2)
    return total
