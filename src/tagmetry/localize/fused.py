"""Fusion by covariance: every marker's own pose weighs by what it knows.

Minimises the sum of `d_i^T C_i^-1 d_i` with `d_i` the difference between the pose and marker i's,
on the group. Of each marker the hypothesis is taken that agrees with the others, so a flip needs
all markers to agree on it; one that agrees in neither is left out. The covariances are those that
the markers' poses have at the common pose: a marker's own is smaller where noise makes it lean.
What is lost against the joint solution:
a marker's two poses with their covariances are less than its corners, so far markers make the
stated covariance too small; and markers of one body are taken to err independently.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtri

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform, perturb_pose, pose_difference
from tagmetry.geometry.arrays import BoolArray, IntArray
from tagmetry.localize.chain import MarkerView, marker_views
from tagmetry.localize.joint.equations import informations
from tagmetry.localize.joint.scene import Scene, scene_of
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.result import CameraHypothesis, Rejection
from tagmetry.localize.seen import SeenMarker

GATE = float(chdtri(6, 1e-4))  # one good marker in ten thousand is turned away
_MEDIAN = 5.35  # median of chi2 with 6 degrees of freedom
_ROUNDS = 5
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
        opinions = _Opinions.of(views, camera)
        surest = sorted(views, key=lambda view: view.expected_error2_m2)[:_MOST]
        starts = [one.T_world_camera for view in surest for one in view.hypotheses]
        rough = _distinct([_fused(opinions, start) for start in starts])[:_MOST]
        return _distinct([_fused(opinions.at(T), T) for T in (one.T_world_camera for one in rough)])


@dataclass(frozen=True, eq=False)
class _Opinions:
    """All hypotheses of all markers in a row.

    Attributes:
        views: The n markers.
        owner: Which of them each hypothesis belongs to, shape (k,).
        poses: T_world_camera of the k hypotheses.
        informations: Of the hypotheses, shape (k, 6, 6).
        surprises: -2 log of their probabilities, shape (k,).
        scene: The corners that they come from.
    """

    views: Sequence[MarkerView]
    owner: IntArray
    poses: RigidTransform
    informations: Array
    surprises: Array
    scene: Scene

    @classmethod
    def of(cls, views: Sequence[MarkerView], camera: Camera) -> "_Opinions":
        pairs = [(n, one) for n, view in enumerate(views) for one in view.hypotheses]
        probability = np.array([one.probability for _, one in pairs])
        return cls(
            views,
            np.array([n for n, _ in pairs]),
            RigidTransform.concatenate([one.T_world_camera for _, one in pairs]),
            np.linalg.inv(np.stack([one.covariance for _, one in pairs])),
            -2 * np.log(np.maximum(probability, 1e-300)),
            scene_of([view.seen for view in views], camera, Knowledge())[0],
        )

    def at(self, T_world_camera: RigidTransform) -> "_Opinions":
        """Return the same with the informations that they would have at a common pose."""
        T = T_world_camera.as_matrix()
        common, in_front = informations(self.scene, T[:3, :3].copy(), T[:3, 3].copy())
        usable = in_front & (np.linalg.eigvalsh(common)[:, 0] > 0)
        kept = np.where(usable[self.owner, None, None], common[self.owner], self.informations)
        return replace(self, informations=kept)


@dataclass(frozen=True, eq=False)
class _Choice:
    """The hypothesis of each marker that lies nearest to a pose.

    Attributes:
        changes: From the pose to the hypotheses, shape (n, 6).
        informations: Of the hypotheses, shape (n, 6, 6).
        costs: Their squared distances and surprises, shape (n,).
    """

    changes: Array
    informations: Array
    costs: Array

    @property
    def agrees(self) -> BoolArray:
        """Which markers agree, (n,): far ones' poses err more than their covariances say."""
        excess = max(1.0, float(np.median(self.costs)) / _MEDIAN)
        return np.asarray(self.costs <= GATE * excess)


def _fused(opinions: _Opinions, start: RigidTransform) -> CameraHypothesis:
    """Return what the markers near a starting pose agree on; `chi2` also counts those left out."""
    T, covariance = start, np.zeros((6, 6))
    for _ in range(_ROUNDS):
        T, covariance = _mean(_chosen(opinions, T), T)
    choice = _chosen(opinions, T)
    keys = [view.marker.key for view in opinions.views]
    used = tuple(key for key, agrees in zip(keys, choice.agrees, strict=True) if agrees)
    left_out = tuple(Rejection(key, _WHY) for key in keys if key not in used)
    cost = float(np.minimum(choice.costs, GATE).sum())
    return CameraHypothesis(T, covariance, 1.0, used, left_out, cost, max(0, 6 * (len(used) - 1)))


def _chosen(opinions: _Opinions, T: RigidTransform) -> _Choice:
    changes = pose_difference(opinions.poses, T)
    informations = opinions.informations
    costs = np.einsum("ki,kij,kj->k", changes, informations, changes) + opinions.surprises
    by_owner = [np.flatnonzero(opinions.owner == n) for n in range(len(opinions.views))]
    nearest = np.array([rows[np.argmin(costs[rows])] for rows in by_owner])
    return _Choice(changes[nearest], informations[nearest], costs[nearest])


def _mean(choice: _Choice, T: RigidTransform) -> tuple[RigidTransform, Array]:
    """Return the information-weighted mean of the poses that agree; of the nearest if none does."""
    taken = choice.agrees if choice.agrees.any() else choice.costs == choice.costs.min()
    informations = choice.informations[taken]
    covariance = np.linalg.inv(informations.sum(axis=0))
    pull = np.einsum("nij,nj->i", informations, choice.changes[taken])
    return perturb_pose(T, covariance @ pull), covariance


def _distinct(solutions: Sequence[CameraHypothesis]) -> tuple[CameraHypothesis, ...]:
    """Return the solutions that differ and are not improbable, the likelier first."""
    kept: list[CameraHypothesis] = []
    for one in sorted(solutions, key=lambda one: one.chi2):
        if all(_deviations(one, other) > _DISTINCT for other in kept):
            kept.append(one)
    weights = np.exp([(kept[0].chi2 - one.chi2) / 2 for one in kept]) if kept else np.zeros(0)
    return tuple(
        replace(one, probability=float(weight / weights.sum()))
        for one, weight in zip(kept, weights, strict=True)
        if weight > _IMPROBABLE
    )


def _deviations(one: CameraHypothesis, other: CameraHypothesis) -> float:
    apart = pose_difference(one.T_world_camera, other.T_world_camera)
    distance2 = float(apart @ np.linalg.solve(other.covariance, apart))
    return float(np.sqrt(max(distance2, 0.0)))
