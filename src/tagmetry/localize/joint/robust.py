"""The first steps from a start: weights that fall with a marker's distance, compiled."""

import numpy as np

from tagmetry.geometry.arrays import Array
from tagmetry.localize.joint.equations import fill_residuals, known_system, marginal, products
from tagmetry.localize.joint.scene import Scene
from tagmetry.localize.joint.small import add, backward, cholesky, forward, kernel, turn

FAR = 1e12  # stands for the squared distance of a marker behind the camera
_HEED = 20.0  # squared distance at which a marker weighs half
_MEDIAN = 7.34  # median of chi2 with 8 degrees of freedom
_STEPS = 10
_SETTLED = 1e-2  # in units of chi2: the exact steps do the rest


@kernel
def robust(scene: Scene, R: Array, t: Array, L: Array) -> tuple[Array, Array, float]:
    """Return the pose (R, t) after some steps, and its robust cost."""
    damping = 1e-3
    systems, distances2 = _by_marker(scene, R, t, L)
    for _ in range(_STEPS):
        spread2 = max(1.0, lower_median(distances2) / _MEDIAN)
        cost = _cost(scene, R, t, distances2, spread2)
        change = step(_weighted(scene, R, t, systems, distances2, spread2), damping)
        tried_R, tried_t = turn(change[3:], R), t + change[:3]
        tried_systems, tried_distances2 = _by_marker(scene, tried_R, tried_t, L)
        gain = cost - _cost(scene, tried_R, tried_t, tried_distances2, spread2)
        if gain >= 0.0:
            R, t, damping = tried_R, tried_t, 0.1 * damping
            systems, distances2 = tried_systems, tried_distances2
            if gain < _SETTLED:
                break
        else:
            damping *= 10.0
    return R, t, _cost(scene, R, t, distances2, 1.0)


@kernel
def score(scene: Scene, R: Array, t: Array, L: Array) -> float:
    """Return a robust cost of a pose, quickly: as if the map were exact."""
    r, distances2 = np.empty((8, 1)), np.full(len(L), FAR)
    for m in range(len(L)):
        if fill_residuals(scene, m, R, t, r):
            forward(L[m], r)
            distances2[m] = min((r * r).sum(), FAR)
    return _cost(scene, R, t, distances2, 1.0)


@kernel
def distances2_of(scene: Scene, R: Array, t: Array, L: Array) -> Array:
    """Return the markers' squared distances, each with the map's error of its own, shape (m,)."""
    return _by_marker(scene, R, t, L)[1]


@kernel
def lower_median(values: Array) -> float:
    """Return the middle one, of an even number the lower of the two in the middle."""
    ordered = values.copy()
    for i in range(1, len(ordered)):
        j, value = i, ordered[i]
        while j > 0 and ordered[j - 1] > value:
            ordered[j] = ordered[j - 1]
            j -= 1
        ordered[j] = value
    return float(ordered[(len(ordered) - 1) // 2])


@kernel
def step(system: Array, damping: float) -> Array:
    """Return Levenberg and Marquardt's change of the pose, shape (6,); zero where there is none."""
    H, root, change = system[1:, 1:].copy(), np.zeros((6, 6)), system[1:, :1].copy()
    for k in range(6):
        H[k, k] *= 1.0 + damping
    out = np.zeros(6)
    if cholesky(H, root):
        forward(root, change)
        for k in range(6):
            out[k] = -change[k, 0]
        backward(root, out)
    return out


@kernel
def _by_marker(scene: Scene, R: Array, t: Array, L: Array) -> tuple[Array, Array]:
    """Return [chi2 g^T; g H] of each marker by itself, (m, 7, 7), and its chi2, (m,)."""
    P, in_front = products(scene, R, t, L)
    systems, distances2 = np.zeros((len(P), 7, 7)), np.full(len(P), FAR)
    for m in range(len(P)):
        if in_front[m]:
            systems[m] = marginal(P[m])
            if systems[m, 0, 0] < FAR:
                distances2[m] = systems[m, 0, 0]
    return systems, distances2


@kernel
def _weighted(
    scene: Scene, R: Array, t: Array, systems: Array, distances2: Array, spread2: float
) -> Array:
    total = known_system(scene, R, t)
    for m in range(len(systems)):
        weight = 1.0 / (spread2 * (1.0 + distances2[m] / (_HEED * spread2)))
        add(systems[m], total, weight)
    return total


@kernel
def _cost(scene: Scene, R: Array, t: Array, distances2: Array, spread2: float) -> float:
    cost = known_system(scene, R, t)[0, 0]
    for m in range(len(distances2)):
        cost += _HEED * np.log1p(distances2[m] / (_HEED * spread2))
    return float(cost)
