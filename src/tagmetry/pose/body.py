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

from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import MarkerBody
from tagmetry.markers.bodies import MarkerKey
from tagmetry.pose.agreement import GATE, Agreement, BodyCorners, agreements, is_chance
from tagmetry.pose.marker import estimate_poses, hypotheses_of, ranked, rms_px
from tagmetry.pose.refine import joined
from tagmetry.pose.result import PoseHypothesis
from tagmetry.pose.stacks import Poses
from tagmetry.pose.whitening import whitening

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
    corners = _corners(own, body)
    starts = _best_two(Poses.of(RigidTransform.concatenate(proposals)), corners, camera)
    return _result(body.name, corners, agreements(starts, corners, camera), camera)


def _of_body(detections: Sequence[Detection], body: MarkerBody) -> list[Detection]:
    """Return the markers that the body carries, each seen once and with usable numbers."""
    keys = [MarkerKey(d.family, d.id) for d in detections]
    carried = body.corners_m.keys()
    return [
        detection
        for key, detection in zip(keys, detections, strict=True)
        if key in carried and keys.count(key) == 1 and _is_usable(detection)
    ]


def _is_usable(detection: Detection) -> bool:
    whole = np.isfinite(whitening(detection.corners_cov_px2[None])).all()
    return bool(whole and np.isfinite(detection.corners_px).all())


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


def _corners(own: Sequence[Detection], body: MarkerBody) -> BodyCorners:
    keys = tuple(MarkerKey(d.family, d.id) for d in own)
    corners_m = body.corners_m
    return BodyCorners(
        keys,
        np.stack([corners_m[key] for key in keys]),
        np.stack([d.corners_px for d in own]),
        np.stack([d.corners_cov_px2 for d in own]),
    )


def _best_two(proposals: Poses, corners: BodyCorners, camera: Camera) -> Poses:
    """Return the best proposal and the best that clearly leans otherwise, or the best twice."""
    order = np.argsort(_scores(proposals, corners, camera), kind="stable")
    ranked_proposals = proposals[order]
    leans = ranked_proposals.turns_rad(ranked_proposals[:1]) > _DISTINCT_RAD
    return ranked_proposals[np.array([0, np.argmax(leans)])]


def _scores(poses: Poses, corners: BodyCorners, camera: Camera) -> Array:
    """Return a cost of each pose that grows with the logarithm of a corner's distance."""
    return np.asarray(np.log1p(corners.distances2(poses, camera) / GATE).sum(axis=(1, 2)))


def _result(name: str, corners: BodyCorners, settled: list[Agreement], camera: Camera) -> BodyPose:
    found = _hypotheses(settled, corners, camera)
    hypotheses = ranked(found)
    if not hypotheses:
        return BodyPose(name, (), (), (), 1.0)
    chosen = settled[min((h.chi2, n) for n, h in enumerate(found) if h is not None)[1]]
    scale = _noise_scale(chosen)
    agreeing = np.asarray(chosen.agrees.any(axis=1))
    return BodyPose(
        name,
        tuple(replace(h, covariance=h.covariance * scale**2) for h in hypotheses),
        tuple(key for key, any_agrees in zip(corners.keys, agreeing, strict=True) if any_agrees),
        tuple((corners.keys[m], int(corner)) for m, corner in np.argwhere(~chosen.agrees)),
        scale,
    )


def _hypotheses(
    settled: list[Agreement], corners: BodyCorners, camera: Camera
) -> list[PoseHypothesis | None]:
    """Return the poses as hypotheses; in their chi2 a corner that disagrees counts as the gate."""
    spread2 = min(agreement.spread2 for agreement in settled)
    chi2 = [a.chi2 / spread2 + GATE * int((~a.agrees).sum()) for a in settled]
    fit = replace(joined([agreement.fit for agreement in settled]), chi2=np.array(chi2))
    return hypotheses_of(fit, np.array([_rms_px(a, corners, camera) for a in settled]))


def _rms_px(agreement: Agreement, corners: BodyCorners, camera: Camera) -> float:
    """Return the reprojection error of the corners that agree."""
    projected = camera.project(agreement.fit.poses.points(corners.p_body.reshape(1, -1, 3)))
    error = (projected.reshape(corners.pixels.shape) - corners.pixels)[agreement.agrees]
    return float(rms_px(error))


def _noise_scale(chosen: Agreement) -> float:
    """Return how much wider than stated agreeing corners scatter; 1 while chance explains it."""
    if is_chance(chosen.chi2, chosen.freedom):
        return 1.0
    return float(np.sqrt(chosen.chi2 / chosen.freedom))
