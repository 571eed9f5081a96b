"""Localization as seed 002 does it: solvePnP for every marker, then a weighted average.

    T_world_camera = T_world_marker * T_marker_camera, for each marker              (section 3.2)
    [x, y, z] = sum([x_i, y_i, z_i] ratio_i),  ratio_i = weight_i / weight_total    (section 3.3)
    angle = atan2(sum(sin(angle_i) ratio_i), sum(cos(angle_i) ratio_i))

How much nearer markers weigh is not told: 1 / distance and 1 / distance^2 are both here. The paper
prints atan of the quotient, which loses two quadrants. This shares no code with tagmetry's own
methods. The corners are OpenCV's, refined in their neighbourhood: as good as those by the AprilTag
library's edges at these sizes, and found where those are lost.
"""

from collections.abc import Mapping

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MarkerMap
from tagmetry.markers import marker_corners_m


def fused_place(
    corners_px: Mapping[int, Array], marker_map: MarkerMap, camera: Camera, power: float
) -> RigidTransform | None:
    """Return T_world_camera as the average of all markers; None where none is seen.

    Args:
        corners_px: By id, each (4, 2).
        marker_map: Where the markers are.
        camera: Intrinsics of the image.
        power: The weight is 1 / distance^power.
    """
    markers = [one for one in marker_map.markers if one.id in corners_px]
    if not markers:
        return None
    poses = [solved_pose(corners_px[one.id], camera, one.size_m) for one in markers]
    cameras = [one.T_world_marker * T.inv() for one, T in zip(markers, poses, strict=True)]
    weights = np.array([float(np.linalg.norm(T.translation)) ** -power for T in poses])
    return _average(cameras, weights / weights.sum())


def solved_pose(corners_px: Array, camera: Camera, size_m: float) -> RigidTransform:
    """Return T_camera_marker by OpenCV's iterative solvePnP."""
    lens = np.array(camera.lens.coefficients)
    _, turn, place_m = cv2.solvePnP(marker_corners_m(size_m), corners_px, camera.matrix, lens)
    return RigidTransform.from_components(np.ravel(place_m), Rotation.from_rotvec(np.ravel(turn)))


def _average(cameras: list[RigidTransform], ratios: Array) -> RigidTransform:
    place_m = ratios @ np.array([T.translation for T in cameras])
    angles_rad = np.array([T.rotation.as_euler("ZYX") for T in cameras])
    mean_rad = np.arctan2(ratios @ np.sin(angles_rad), ratios @ np.cos(angles_rad))
    return RigidTransform.from_components(place_m, Rotation.from_euler("ZYX", mean_rad))
