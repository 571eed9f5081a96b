"""The poses that are worth a close look: where the best proposals lead, compiled."""

import numpy as np

from tagmetry.geometry.arrays import Array, IntArray
from tagmetry.localize.joint.equations import whiteners
from tagmetry.localize.joint.robust import robust, score
from tagmetry.localize.joint.scene import Scene
from tagmetry.localize.joint.small import kernel

_MOST = 4
_STARTS_APART = 0.05  # rad, or share of the distance, between two that are worth following
_ENDS_APART = 1e-3  # the same between two poses that the robust steps have led to
_HOPELESS = 60.0  # a cost by so much higher has a probability of 1e-13


@kernel
def starts(scene: Scene, Rs: Array, ts: Array) -> tuple[Array, Array]:
    """Return where proposals R_world_camera (n, 3, 3) and t (n, 3) lead: up to four that differ."""
    L = whiteners(scene, np.full(len(scene.noise), -1))
    chosen = _best(scene, Rs, ts, _scores(scene, Rs, ts, L))
    count = len(chosen)
    led_Rs, led_ts, costs = np.empty((count, 3, 3)), np.empty((count, 3)), np.empty(count)
    for k in range(count):
        led_Rs[k], led_ts[k], costs[k] = robust(scene, Rs[chosen[k]], ts[chosen[k]], L)
    kept = _worthwhile(scene, led_Rs, led_ts, costs)
    return led_Rs[kept], led_ts[kept]


@kernel
def _scores(scene: Scene, Rs: Array, ts: Array, L: Array) -> Array:
    """Return the robust costs of poses, infinite for those that are none, shape (n,)."""
    costs = np.full(len(Rs), np.inf)
    for n in range(len(Rs)):
        if np.isfinite(Rs[n].sum() + ts[n].sum()):
            costs[n] = score(scene, Rs[n], ts[n], L)
    return costs


@kernel
def _best(scene: Scene, Rs: Array, ts: Array, costs: Array) -> IntArray:
    """Return the numbers of the best poses that are apart."""
    chosen, count = np.empty(_MOST, dtype=np.int64), 0
    left = costs.copy()
    for _ in range(len(costs)):
        n = _lowest(left)
        if count == _MOST or not np.isfinite(left[n]):
            break
        left[n] = np.inf
        if _is_new(scene, Rs, ts, n, chosen[:count], _STARTS_APART):
            chosen[count] = n
            count += 1
    return chosen[:count]


@kernel
def _worthwhile(scene: Scene, Rs: Array, ts: Array, costs: Array) -> IntArray:
    """Return the numbers of the poses that are not hopeless and not one another, best first."""
    chosen, count = np.empty(len(costs), dtype=np.int64), 0
    left = costs.copy()
    for _ in range(len(costs)):
        n = _lowest(left)
        if costs[n] > costs[_lowest(costs)] + _HOPELESS:
            break
        left[n] = np.inf
        if _is_new(scene, Rs, ts, n, chosen[:count], _ENDS_APART):
            chosen[count] = n
            count += 1
    return chosen[:count]


@kernel
def _lowest(values: Array) -> int:
    best = 0
    for n in range(1, len(values)):
        if values[n] < values[best]:
            best = n
    return best


@kernel
def _is_new(scene: Scene, Rs: Array, ts: Array, n: int, chosen: IntArray, apart: float) -> bool:
    """Say whether a pose is turned against all others or away from them, for its distance."""
    distance2 = _distance2(ts[n], scene.corners[0, 0])
    for other in chosen:
        chord2 = 0.0  # 8 sin^2(angle / 2)
        for i in range(3):
            for j in range(3):
                chord2 += (Rs[n, i, j] - Rs[other, i, j]) ** 2
        moved2 = _distance2(ts[n], ts[other])
        if chord2 < 2.0 * apart**2 and moved2 < apart**2 * distance2:
            return False
    return True


@kernel
def _distance2(p: Array, q: Array) -> float:
    return float((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2)
