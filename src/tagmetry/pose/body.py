"""The pose of a rigid body or board: one joint solution from all corners that are seen.

Every marker proposes its own two poses of the body. Each proposal is scored on the corners of all,
with a cost that stops growing for corners far off, so a wrong or moved marker cannot pull; the best
one and its nearest rival are then refined on the corners that agree. A flat board keeps its
mirrored second solution, with its probability, as a single marker does.

Frames: `p_camera = T_camera_body.apply(p_body)`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag
from scipy.special import chdtri

from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import MarkerBody
from tagmetry.markers.bodies import MarkerKey
from tagmetry.pose.marker import estimate_poses, hypotheses_of, ranked, whitening
from tagmetry.pose.refine import Poses, Sightings, refine, residuals_px
from tagmetry.pose.result import PoseHypothesis

_GATE = 16.3  # chi2 with 2 degrees of freedom: one good corner in 3500 is turned away
_MEDIAN = 1.386  # median of chi2 with 2 degrees of freedom
_CAUCHY = 5.7  # Cauchy's tuning constant squared: 95 % efficient on clean noise
_ROUNDS = 8
_DISTINCT_RAD = np.deg2rad(3.0)


@dataclass(frozen=True)
class BodyPose:
    """The pose of a rigid body of markers.

    Attributes:
        name: What the body is called.
        hypotheses: `T_camera_marker` is here the body's pose; the likelier first; none where no
            marker of the body was seen.
        used: The markers that had at least one agreeing corner.
        outliers: Corners that disagree, as (marker, corner index).
        noise_scale: By how much the corners scatter more than their covariance says, at least 1;
            the hypotheses' covariances are already widened by it.
    """

    name: str
    hypotheses: tuple[PoseHypothesis, ...]
    used: tuple[MarkerKey, ...]
    outliers: tuple[tuple[MarkerKey, int], ...]
    noise_scale: float

    @property
    def best(self) -> PoseHypothesis:
        """The most probable hypothesis."""
        if not self.hypotheses:
            raise InputError(f"body {self.name!r} has no pose: none of its markers was seen")
        return self.hypotheses[0]

    @property
    def alternatives(self) -> tuple[PoseHypothesis, ...]:
        """The others."""
        return self.hypotheses[1:]

    @property
    def covariance(self) -> Array:
        """Covariance of the best hypothesis, shape (6, 6)."""
        return self.best.covariance


def estimate_body_pose(
    detections: Sequence[Detection], body: MarkerBody, camera: Camera
) -> BodyPose:
    """Return the pose of a body from all its markers in an image.

    Args:
        detections: Markers of the image; those that the body does not carry are passed over, and so
            is a marker that is seen twice.
        body: The markers and their places; a board gives it by `board.body()`.
        camera: Intrinsics of the image.
    """
    own = _of_body(detections, body)
    proposals = _proposals(own, body, camera)
    if not proposals:
        return BodyPose(body.name, (), (), (), 1.0)
    seen = _seen(own, body)
    settled = [_settled(start, seen, camera) for start in _best_two(proposals, seen, camera)]
    return _result(body.name, seen, settled, camera)


@dataclass(frozen=True)
class _Seen:
    """The corners of m markers of one body."""

    keys: tuple[MarkerKey, ...]
    p_body: Array  # (m, 4, 3)
    pixels: Array  # (m, 4, 2)
    covariances: Array  # (m, 8, 8)

    def sightings(self, widening: Array) -> Sightings:
        """Return all corners as one sighting, each one's noise widened by a factor (m, 4)."""
        factors = np.repeat(widening, 2, axis=1)
        W = whitening(factors[:, :, None] * self.covariances * factors[:, None, :])
        return Sightings(
            self.p_body.reshape(1, -1, 3), self.pixels.reshape(1, -1, 2), block_diag(*W)[None]
        )

    def distances2(self, pose: Poses, camera: Camera) -> Array:
        """Return each corner's squared residual by its own covariance, shape (m, 4)."""
        projected = camera.project(pose.points(self.p_body.reshape(1, -1, 3)))
        error = projected.reshape(-1, 2) - self.pixels.reshape(-1, 2)
        blocks = np.stack([self.covariances[:, i : i + 2, i : i + 2] for i in (0, 2, 4, 6)], axis=1)
        solved = np.linalg.solve(blocks.reshape(-1, 2, 2), error[..., None])[..., 0]
        distances2 = (error * solved).sum(axis=-1).reshape(self.pixels.shape[:2])
        return np.where(np.isfinite(distances2), distances2, np.inf)


@dataclass(frozen=True)
class _Settled:
    """A refined pose and the corners that agree with it."""

    pose: Poses
    agrees: BoolArray  # (m, 4)
    spread2: float  # by how much the corners' variances are exceeded, robustly


def _of_body(detections: Sequence[Detection], body: MarkerBody) -> list[Detection]:
    keys = [MarkerKey(d.family, d.id) for d in detections]
    carried = body.corners_m.keys()
    return [
        detection
        for key, detection in zip(keys, detections, strict=True)
        if key in carried and keys.count(key) == 1
    ]


def _proposals(own: Sequence[Detection], body: MarkerBody, camera: Camera) -> list[RigidTransform]:
    """Return the body's pose as each marker's own hypotheses say: T_camera_body."""
    mounted = {MarkerKey(m.family, m.id): m for m in body.markers}
    markers = [mounted[MarkerKey(d.family, d.id)] for d in own]
    poses = estimate_poses(own, camera, [marker.size_m for marker in markers])
    return [
        hypothesis.T_camera_marker * marker.T_body_marker.inv()
        for pose, marker in zip(poses, markers, strict=True)
        for hypothesis in pose.hypotheses
    ]


def _seen(own: Sequence[Detection], body: MarkerBody) -> _Seen:
    keys = tuple(MarkerKey(d.family, d.id) for d in own)
    corners_m = body.corners_m
    return _Seen(
        keys,
        np.stack([corners_m[key] for key in keys]),
        np.stack([d.corners_px for d in own]),
        np.stack([d.corners_cov_px2 for d in own]),
    )


def _best_two(proposals: list[RigidTransform], seen: _Seen, camera: Camera) -> list[Poses]:
    """Return the best proposal, and the best of those that lean clearly otherwise."""
    scored = sorted(proposals, key=lambda T: _score(_stacked(T), seen, camera))
    best = scored[0]
    rivals = (T for T in scored[1:] if _turn_rad(best, T) > _DISTINCT_RAD)
    return [_stacked(T) for T in (best, *list(rivals)[:1])]


def _score(pose: Poses, seen: _Seen, camera: Camera) -> float:
    """Return a cost that grows with the logarithm of a corner's distance."""
    distances2 = np.minimum(seen.distances2(pose, camera), 1e12)
    return float(np.log1p(distances2 / _GATE).sum())


def _settled(start: Poses, seen: _Seen, camera: Camera) -> _Settled:
    """Refine with Cauchy's weights, then on the corners that agree until they stay the same."""
    pose = start
    for _ in range(_ROUNDS):
        distances2, spread2 = _spread(pose, seen, camera)
        widening = np.sqrt(1 + distances2 / (_CAUCHY * spread2))
        pose, _ = refine(pose, seen.sightings(widening), camera, max_iterations=3)
    agrees = np.zeros(seen.pixels.shape[:2], dtype=bool)
    for _ in range(_ROUNDS):
        distances2, spread2 = _spread(pose, seen, camera)
        agreed, agrees = agrees, distances2 <= _GATE * spread2
        if (agreed == agrees).all():
            break
        pose, _ = refine(pose, seen.sightings(_ignoring(~agrees)), camera)
    return _Settled(pose, agrees, spread2)


def _spread(pose: Poses, seen: _Seen, camera: Camera) -> tuple[Array, float]:
    """Return the corners' squared distances, and how far their median exceeds what is expected."""
    distances2 = np.minimum(seen.distances2(pose, camera), 1e12)
    return distances2, max(1.0, float(np.median(distances2)) / _MEDIAN)


def _ignoring(corners: BoolArray) -> Array:
    """Return noise factors that take some corners out of the solution."""
    return np.where(corners, 1e6, 1.0)


def _result(name: str, seen: _Seen, settled: list[_Settled], camera: Camera) -> BodyPose:
    spread2 = min(candidate.spread2 for candidate in settled)
    found = [_hypothesis(candidate, spread2, seen, camera) for candidate in settled]
    hypotheses = ranked([hypothesis for hypothesis in found if hypothesis is not None])
    if not hypotheses:
        return BodyPose(name, (), (), (), 1.0)
    chosen = settled[found.index(min((h for h in found if h), key=lambda h: h.chi2))]
    scale = _noise_scale(chosen, seen, camera)
    agreeing = np.asarray(chosen.agrees.any(axis=1))
    return BodyPose(
        name,
        tuple(replace(h, covariance=h.covariance * scale**2) for h in hypotheses),
        tuple(key for key, any_agrees in zip(seen.keys, agreeing, strict=True) if any_agrees),
        tuple((seen.keys[m], int(corner)) for m, corner in np.argwhere(~chosen.agrees)),
        scale,
    )


def _hypothesis(
    candidate: _Settled, spread2: float, seen: _Seen, camera: Camera
) -> PoseHypothesis | None:
    """Return the pose as a hypothesis; its chi2 counts every corner, each up to the gate."""
    sightings = seen.sightings(_ignoring(~candidate.agrees))
    distances2 = np.minimum(seen.distances2(candidate.pose, camera) / spread2, _GATE)
    chi2 = np.array([distances2.sum()])
    (hypothesis,) = hypotheses_of(candidate.pose, chi2, sightings, camera)
    if hypothesis is None:
        return None
    error = residuals_px(candidate.pose, sightings, camera)[0][candidate.agrees.ravel()]
    return replace(hypothesis, reprojection_rms_px=float(np.sqrt((error**2).sum(axis=1).mean())))


def _noise_scale(chosen: _Settled, seen: _Seen, camera: Camera) -> float:
    """Return how much wider than stated agreeing corners scatter; 1 while chance explains it."""
    freedom = 2 * int(chosen.agrees.sum()) - 6
    if freedom < 1:
        return 1.0
    sightings = seen.sightings(_ignoring(~chosen.agrees))
    error = residuals_px(chosen.pose, sightings, camera).reshape(-1)
    chi2 = float(((sightings.whitening[0] @ error) ** 2).sum())
    if chi2 < chdtri(freedom, 0.01):
        return 1.0
    return float(np.sqrt(chi2 / freedom))


def _stacked(T_camera_body: RigidTransform) -> Poses:
    return Poses(T_camera_body.rotation.as_matrix()[None], T_camera_body.translation[None])


def _turn_rad(one: RigidTransform, other: RigidTransform) -> float:
    return float((one.rotation * other.rotation.inv()).magnitude())
