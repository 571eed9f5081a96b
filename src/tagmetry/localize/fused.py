"""Fusion by covariance: every marker's own pose weighs by what it knows.

Minimises the sum of `d_i^T C_i^-1 d_i` with `d_i` the difference between the pose and marker i's,
on the group. Of each marker the hypothesis is taken that agrees with the others, so a flip needs
all markers to agree on it; one that agrees in neither is left out. The covariances are those that
the markers' poses have at the common pose: a marker's own is smaller where noise makes it lean.
What is lost against the joint solution:
a marker's two poses with their covariances are less than its corners. Far markers' poses disagree
by more than their covariances say; the common one's covariance then grows by as much. Markers of
one body are taken to err independently.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize.chain import MarkerView, marker_views
from tagmetry.localize.joint.equations import informations
from tagmetry.localize.joint.fusion import GATE, Agreement, Opinions, agreement
from tagmetry.localize.joint.scene import Scene, scene_of
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.result import CameraHypothesis, Rejection, excess
from tagmetry.localize.seen import SeenMarker
from tagmetry.markers.bodies import MarkerKey

_DISTINCT = 3.0  # standard deviations between two solutions that are not one
_IMPROBABLE = 1e-6
_MOST = 4  # markers to start from, and rough solutions that are worth a second look
_WHY = "its pose disagrees with the other markers'"


@dataclass(frozen=True)
class FusedByCovariance:
    """The information-weighted mean of the markers' own poses."""

    name: str = "covariance"
    heeds_knowledge: bool = False

    def hypotheses(
        self,
        seen: Sequence[SeenMarker],
        camera: Camera,
        known: Knowledge,  # noqa: ARG002
    ) -> tuple[CameraHypothesis, ...]:
        """Return the poses that markers agree on, started from the surest markers' own."""
        views = marker_views(seen, camera)
        if not views:
            return ()
        opinions = _opinions(views)
        rough = _distinct([agreement(opinions, *start) for start in _starts(views, opinions)])
        scene = scene_of([view.seen for view in views], camera, Knowledge())[0]
        exact = [agreement(_at(opinions, scene, one), one.R, one.t) for one in rough[:_MOST]]
        return _hypotheses(_distinct(exact), [view.marker.key for view in views])


def _opinions(views: Sequence[MarkerView]) -> Opinions:
    pairs = [(n, one) for n, view in enumerate(views) for one in view.hypotheses]
    T = np.stack([one.T_world_camera.as_matrix() for _, one in pairs])
    probabilities = np.array([one.probability for _, one in pairs])
    return Opinions(
        np.ascontiguousarray(T[:, :3, :3]),
        np.ascontiguousarray(T[:, :3, 3]),
        np.linalg.inv(np.stack([one.covariance for _, one in pairs])),
        -2 * np.log(np.maximum(probabilities, 1e-300)),
        np.array([n for n, _ in pairs]),
        np.array([len(views)]),
    )


def _starts(views: Sequence[MarkerView], opinions: Opinions) -> list[tuple[Array, Array]]:
    """Return the poses R, t that the surest markers have."""
    surest = np.argsort([view.expected_error2_m2 for view in views])[:_MOST]
    return [
        (opinions.Rs[k], opinions.ts[k]) for k in np.flatnonzero(np.isin(opinions.owner, surest))
    ]


def _at(opinions: Opinions, scene: Scene, one: Agreement) -> Opinions:
    """Return the same with the informations that they would have at a common pose."""
    common, in_front = informations(scene, one.R, one.t)
    usable = in_front & (np.linalg.eigvalsh(common)[:, 0] > 0)
    owner = opinions.owner
    kept = np.where(usable[owner, None, None], common[owner], opinions.informations)
    return opinions._replace(informations=kept)


def _distinct(solutions: Sequence[Agreement]) -> list[Agreement]:
    """Return the solutions that differ, the likelier first."""
    kept: list[Agreement] = []
    for one in sorted(solutions, key=_cost):
        if all(_deviations(one, other) > _DISTINCT for other in kept):
            kept.append(one)
    return kept


def _cost(one: Agreement) -> float:
    """Return the squared distances of all markers, those left out included."""
    return float(np.minimum(one.costs, GATE).sum())


def _deviations(one: Agreement, other: Agreement) -> float:
    turn = one.R @ other.R.T
    if np.trace(turn) < 2.9:
        return float("inf")
    x, y, z = (turn - turn.T)[[2, 0, 1], [1, 2, 0]] / 2
    apart = np.array([*(one.t - other.t), x, y, z])
    return float(np.sqrt(max(apart @ other.information @ apart, 0.0)))


def _hypotheses(
    solutions: Sequence[Agreement], keys: Sequence[MarkerKey]
) -> tuple[CameraHypothesis, ...]:
    weights = np.exp([(_cost(solutions[0]) - _cost(one)) / 2 for one in solutions])
    return tuple(
        _hypothesis(one, keys, float(weight / weights.sum()))
        for one, weight in zip(solutions, weights, strict=True)
        if weight > _IMPROBABLE
    )


def _hypothesis(one: Agreement, keys: Sequence[MarkerKey], probability: float) -> CameraHypothesis:
    used = tuple(key for key, agrees in zip(keys, one.agrees, strict=True) if agrees)
    left_out = tuple(Rejection(key, _WHY) for key in keys if key not in used)
    freedom = max(0, 6 * (len(used) - 1))
    chi2 = float(one.costs[one.agrees].sum())
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = one.R, one.t
    return CameraHypothesis(
        RigidTransform.from_matrix(matrix),
        np.asarray(np.linalg.inv(one.information) * excess(chi2, freedom)),
        probability,
        used,
        left_out,
        _cost(one),
        freedom,
    )
