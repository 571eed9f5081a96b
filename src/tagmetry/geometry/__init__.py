"""Rigid transforms, planes, angles, and how uncertainty travels through them."""

from tagmetry.geometry.angles import mean_angle_rad, mean_rotation, wrap_angle_rad
from tagmetry.geometry.arrays import Array
from tagmetry.geometry.homography import apply_homography, square_to_quad
from tagmetry.geometry.planes import Plane
from tagmetry.geometry.transforms import (
    RigidTransform,
    cross_matrix,
    perturb_pose,
    pose_difference,
)
from tagmetry.geometry.uncertainty import UncertainTransform, mahalanobis_squared

__all__ = [
    "Array",
    "Plane",
    "RigidTransform",
    "UncertainTransform",
    "apply_homography",
    "cross_matrix",
    "mahalanobis_squared",
    "mean_angle_rad",
    "mean_rotation",
    "perturb_pose",
    "pose_difference",
    "square_to_quad",
    "wrap_angle_rad",
]
