"""What markers' own poses agree on, weighted by what each knows, compiled.

From a start, of each marker the hypothesis is taken that lies nearest, by its information and its
probability; those that agree are averaged on the group, and so on from there.
"""

from typing import NamedTuple

import numpy as np

from tagmetry.geometry.arrays import Array, BoolArray, IntArray
from tagmetry.localize.joint.robust import lower_median
from tagmetry.localize.joint.small import (
    backward,
    cholesky,
    forward,
    kernel,
    rotation_vector,
    turn,
)

GATE = 27.856  # chi2 with 6 degrees of freedom: one good marker in ten thousand is turned away
_MEDIAN = 5.35  # median of chi2 with 6 degrees of freedom
_ROUNDS = 5


class Opinions(NamedTuple):
    """All k hypotheses of n markers in a row.

    Attributes:
        Rs: R_world_camera, shape (k, 3, 3).
        ts: Shape (k, 3), metres.
        informations: On the left in the world, shape (k, 6, 6).
        surprises: -2 log of their probabilities, shape (k,).
        owner: Which marker each belongs to, 0 to n - 1, shape (k,).
        markers: How many markers there are, shape (1,).
    """

    Rs: Array
    ts: Array
    informations: Array
    surprises: Array
    owner: IntArray
    markers: IntArray


class Agreement(NamedTuple):
    """A pose and the markers that agree with it.

    Attributes:
        R: R_world_camera, shape (3, 3).
        t: Shape (3,), metres.
        information: Of the agreeing ones together, shape (6, 6).
        costs: Squared distances and surprises of the markers, shape (n,).
        agrees: Which markers agree, shape (n,).
    """

    R: Array
    t: Array
    information: Array
    costs: Array
    agrees: BoolArray


@kernel
def agreement(opinions: Opinions, R: Array, t: Array) -> Agreement:
    """Return what the markers near a starting pose agree on."""
    information = np.zeros((6, 6))
    for _ in range(_ROUNDS):
        nearest, changes, costs = _nearest(opinions, R, t)
        agrees = _agreeing(costs)
        information, pull = _pull(opinions, nearest, changes, agrees)
        root = np.zeros((6, 6))
        if not cholesky(information, root):
            break
        change = pull.copy()
        forward(root, change)
        step = change[:, 0].copy()
        backward(root, step)
        R, t = turn(step[3:], R), t + step[:3]
    nearest, changes, costs = _nearest(opinions, R, t)
    return Agreement(R, t, information, costs, _agreeing(costs))


@kernel
def _nearest(opinions: Opinions, R: Array, t: Array) -> tuple[IntArray, Array, Array]:
    """Return each marker's nearest hypothesis, the change to it (n, 6), and its cost."""
    n = opinions.markers[0]
    nearest, changes, costs = np.zeros(n, dtype=np.int64), np.zeros((n, 6)), np.full(n, np.inf)
    for k in range(len(opinions.owner)):
        change = np.empty(6)
        change[3:] = rotation_vector(opinions.Rs[k], R)
        cost = opinions.surprises[k]
        for i in range(3):
            change[i] = opinions.ts[k, i] - t[i]
        for i in range(6):
            for j in range(6):
                cost += change[i] * opinions.informations[k, i, j] * change[j]
        m = opinions.owner[k]
        if cost < costs[m]:
            nearest[m], costs[m] = k, cost
            changes[m] = change
    return nearest, changes, costs


@kernel
def _agreeing(costs: Array) -> BoolArray:
    """Return who agrees: far markers' poses err more than their covariances say; someone does."""
    excess = max(1.0, lower_median(costs) / _MEDIAN)
    agrees = np.zeros(len(costs), dtype=np.bool_)
    best = 0
    for m in range(len(costs)):
        agrees[m] = costs[m] <= GATE * excess
        if costs[m] < costs[best]:
            best = m
    agrees[best] = True
    return agrees


@kernel
def _pull(
    opinions: Opinions, nearest: IntArray, changes: Array, agrees: BoolArray
) -> tuple[Array, Array]:
    """Return the agreeing ones' information (6, 6), and whither they pull (6, 1)."""
    information, pull = np.zeros((6, 6)), np.zeros((6, 1))
    for m in range(len(agrees)):
        if agrees[m]:
            for i in range(6):
                for j in range(6):
                    one = opinions.informations[nearest[m], i, j]
                    information[i, j] += one
                    pull[i, 0] += one * changes[m, j]
    return information, pull
