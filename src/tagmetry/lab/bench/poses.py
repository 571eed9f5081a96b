"""How far poses are off that follow from an engine's corners, all by the same solver.

The corners count as equally uncertain, whatever the engine knows about them, so that it is the
corners that are compared.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform
from tagmetry.lab.bench.case import Seen
from tagmetry.pose import MarkerPose, estimate_poses

_VARIANCE_PX2 = 0.1**2  # the same for all corners; its size does not matter


@dataclass(frozen=True)
class PoseErrors:
    """Of several markers.

    Attributes:
        position_percent: Errors of their places, of their distances.
        angle_deg: Errors of their rotations.
        flips: How often the other hypothesis was nearer to the truth.
    """

    position_percent: list[float]
    angle_deg: list[float]
    flips: int


def pose_errors(corners_px: Array, Ts_camera_marker: RigidTransform, seen: Seen) -> PoseErrors:
    """Return the errors of the poses of n markers.

    Args:
        corners_px: As an engine gives them, shape (n, 4, 2).
        Ts_camera_marker: Where they are, n.
        seen: Camera and size.
    """
    noise_px2 = np.eye(8) * _VARIANCE_PX2
    detections = [Detection("", 0, corners, noise_px2, 0, 1.0) for corners in corners_px]
    poses = estimate_poses(detections, seen.camera, [seen.size_m] * len(detections))
    judged = [(p, Ts_camera_marker[n]) for n, p in enumerate(poses) if p.hypotheses]
    return PoseErrors(
        [_position_percent(pose, truth) for pose, truth in judged],
        [_angle_deg(pose.best.T_camera_marker, truth) for pose, truth in judged],
        sum(_is_flipped(pose, truth) for pose, truth in judged),
    )


def _position_percent(pose: MarkerPose, truth: RigidTransform) -> float:
    off_m = np.linalg.norm(pose.best.T_camera_marker.translation - truth.translation)
    return float(100 * off_m / np.linalg.norm(truth.translation))


def _angle_deg(one: RigidTransform, other: RigidTransform) -> float:
    return float(np.degrees((one.rotation.inv() * other.rotation).magnitude()))


def _is_flipped(pose: MarkerPose, truth: RigidTransform) -> bool:
    angles_deg = [_angle_deg(one.T_camera_marker, truth) for one in pose.hypotheses]
    return angles_deg[0] > min(angles_deg)
