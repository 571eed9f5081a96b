"""From corners to poses, with both solutions of a flat marker and their covariances."""

from tagmetry.pose.body import BodyPose, estimate_body_pose
from tagmetry.pose.marker import estimate_pose, estimate_poses
from tagmetry.pose.result import MarkerPose, PoseHypothesis

__all__ = [
    "BodyPose",
    "MarkerPose",
    "PoseHypothesis",
    "estimate_body_pose",
    "estimate_pose",
    "estimate_poses",
]
