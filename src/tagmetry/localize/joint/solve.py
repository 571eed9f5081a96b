"""One camera pose from the corners of all markers, robust to wrong ones and to flips.

Every marker proposes its own two poses of the camera. Each is scored on the corners of all, with a
cost that stops growing for markers far off; the best that differ are led to what the markers agree
on. Where two solutions remain, as for a marker alone or for several in a plane far off, both are
given with their probabilities,

    P_i ~ exp(-cost_i / 2),   cost_i = chi2_i + MARKER_COST (markers) + CORNER_COST (corners),

counting the markers and corners that are left out.

Reference: the scoring of one marker's hypotheses on the corners of all is the idea of ArUco's map
tracker; the elimination of the map's error is that of nuisance parameters in least squares.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.localize.joint.consensus import CORNER_COST, MARKER_COST, Consensus, consensus
from tagmetry.localize.joint.proposals import proposals
from tagmetry.localize.joint.scene import scene_of
from tagmetry.localize.joint.starts import starts
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.result import CameraHypothesis, Rejection, excess
from tagmetry.localize.seen import SeenMarker
from tagmetry.markers.bodies import MarkerKey

_SAME = 0.1  # standard deviations between two solutions that are one
_IMPROBABLE = 1e-9


@dataclass(frozen=True)
class JointCorners:
    """Maximum likelihood over the corners of all markers that agree."""

    name: str = "joint"
    heeds_knowledge: bool = True

    def hypotheses(
        self, seen: Sequence[SeenMarker], camera: Camera, known: Knowledge
    ) -> tuple[CameraHypothesis, ...]:
        """Return the poses that explain the corners, by falling probability."""
        scene, placed, shown = scene_of(seen, camera, known)
        if not len(shown):
            return ()
        keys = [seen[n].marker.key for n in shown]
        led_to = starts(scene, *proposals(placed))
        found = [consensus(scene, R, t) for R, t in zip(*led_to, strict=True)]
        return _hypotheses(_different(found), keys, known)


def _different(found: Sequence[Consensus]) -> list[Consensus]:
    """Return the solutions that are one, each once, by rising cost."""
    spread2 = min((one.spread2 for one in found), default=1.0)
    kept: list[Consensus] = []
    for one in sorted(found, key=lambda one: _cost(one, spread2)):
        usable = np.isfinite(one.system).all() and one.agrees.any()
        if usable and all(_deviations(one, other) > _SAME for other in kept):
            kept.append(one)
    return kept


def _cost(one: Consensus, spread2: float) -> float:
    """Return chi2, with what a marker or a corner costs that is left out."""
    left_out = MARKER_COST * int((~one.agrees).sum()) + CORNER_COST * int((one.dropped >= 0).sum())
    return float(one.system[0, 0]) / spread2 + left_out


def _deviations(one: Consensus, other: Consensus) -> float:
    """Return how many standard deviations lie between two solutions; many for large turns."""
    turn = one.R @ other.R.T
    if np.trace(turn) < 2.9:
        return float("inf")
    x, y, z = (turn - turn.T)[[2, 0, 1], [1, 2, 0]] / 2
    apart = np.array([*(one.t - other.t), x, y, z])
    return float(np.sqrt(max(apart @ other.system[1:, 1:] @ apart, 0.0)))


def _hypotheses(
    solutions: Sequence[Consensus], keys: Sequence[MarkerKey], known: Knowledge
) -> tuple[CameraHypothesis, ...]:
    if not solutions:
        return ()
    spread2 = min(one.spread2 for one in solutions)
    costs = np.array([_cost(one, spread2) for one in solutions])
    weights = np.exp((costs.min() - costs) / 2)
    shares = weights / weights.sum()
    return tuple(
        _hypothesis(one, keys, known, float(share))
        for one, share in zip(solutions, shares, strict=True)
        if share > _IMPROBABLE
    )


def _hypothesis(
    one: Consensus, keys: Sequence[MarkerKey], known: Knowledge, probability: float
) -> CameraHypothesis:
    freedom = _freedom(one, known)
    chi2 = float(one.system[0, 0])
    distances = np.sqrt(one.distances2)
    return CameraHypothesis(
        _transform(one),
        np.asarray(np.linalg.inv(one.system[1:, 1:]) * excess(chi2, freedom), dtype=np.float64),
        probability,
        tuple(key for key, agrees in zip(keys, one.agrees, strict=True) if agrees),
        tuple(
            Rejection(key, f"it disagrees with the other markers by {distance:.0f} deviations")
            for key, agrees, distance in zip(keys, one.agrees, distances, strict=True)
            if not agrees
        ),
        chi2,
        freedom,
    )


def _transform(one: Consensus) -> RigidTransform:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = one.R, one.t
    return RigidTransform.from_matrix(matrix)


def _freedom(one: Consensus, known: Knowledge) -> int:
    """Return by how many numbers what agrees and what is known exceeds the pose's six."""
    seen = 8 * int(one.agrees.sum()) - 2 * int((one.dropped >= 0).sum())
    return seen + 2 * len(known.ups) + len(known.heights) - 6
