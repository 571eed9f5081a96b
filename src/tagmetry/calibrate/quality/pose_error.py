"""What a calibration's errors do to the pose of a marker, in millimetres and degrees.

A pose is the one that fits best: J_p^T W J_p dp + J_p^T W J_d dd = 0 for a small error dd of the
intrinsics. So the marker is measured wrong by dp = -(J_p^T W J_p)^-1 J_p^T W J_d dd, the same in
every picture, however many are averaged; the noise of corners comes on top and averages out.

Frames: `camera` x right, y down, z forward; `marker` x right, y up, z out of its face.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.quality.places import Place, poses_at
from tagmetry.calibrate.quality.solved import honest_covariance
from tagmetry.calibrate.result import Calibration
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, cross_matrix
from tagmetry.markers import marker_corners_m


@dataclass(frozen=True, eq=False)
class PoseError:
    """How wrong a marker's pose is at a place, one standard deviation.

    Attributes:
        place: Where.
        T_camera_marker: The pose there.
        by_calibration: Covariance that the calibration alone gives, shape (6, 6), (translation,
            rotation vector) on the left in the camera frame, m and rad.
        by_corners: Covariance that the corners' noise gives in one picture.
    """

    place: Place
    T_camera_marker: RigidTransform
    by_calibration: Array
    by_corners: Array

    @property
    def position_mm(self) -> Array:
        """By the calibration, along x, y and z of the camera, shape (3,)."""
        return np.sqrt(np.diag(self.by_calibration)[:3]) * 1e3

    @property
    def distance_mm(self) -> float:
        """By the calibration, along the line of sight."""
        sight = np.asarray(self.T_camera_marker.translation)
        sight = sight / np.linalg.norm(sight)
        return float(np.sqrt(sight @ self.by_calibration[:3, :3] @ sight) * 1e3)

    @property
    def worst_mm(self) -> float:
        """By the calibration, in the worst direction."""
        return float(np.sqrt(np.linalg.eigvalsh(self.by_calibration[:3, :3])[-1]) * 1e3)

    @property
    def worst_deg(self) -> float:
        """By the calibration, about the worst axis."""
        return _worst_deg(self.by_calibration)

    @property
    def worst_with_corners_mm(self) -> float:
        """By calibration and corners, in the worst direction."""
        both = (self.by_calibration + self.by_corners)[:3, :3]
        return float(np.sqrt(np.linalg.eigvalsh(both)[-1]) * 1e3)

    @property
    def worst_with_corners_deg(self) -> float:
        """By calibration and corners, about the worst axis."""
        return _worst_deg(self.by_calibration + self.by_corners)


def pose_error(
    calibration: Calibration,
    size_m: float,
    places: Sequence[Place],
    corner_sd_px: float = 0.1,
) -> tuple[PoseError, ...]:
    """Return how wrong a marker's pose is at places.

    Args:
        calibration: What the camera was solved from.
        size_m: Side of the marker's black square.
        places: Where the marker is.
        corner_sd_px: Standard deviation of the marker's corners along an axis.

    Raises:
        InputError: A size, distance or deviation that is not positive; a marker that the lens does
            not show whole from its face.
    """
    _check_positive(size_m=size_m, corner_sd_px=corner_sd_px)
    covariance = honest_covariance(calibration)
    return tuple(
        _pose_error(calibration.camera, covariance, size_m, place, corner_sd_px) for place in places
    )


def _pose_error(
    camera: Camera, covariance: Array, size_m: float, place: Place, corner_sd_px: float
) -> PoseError:
    _check_positive(distance_m=place.distance_m)
    T = poses_at(camera, [place])[0]
    arms = T.rotation.apply(marker_corners_m(size_m))
    p_camera = arms + T.translation
    pixels, by_point = camera.project_with_jacobian(p_camera)
    if not np.isfinite(pixels).all() or place.tilt_deg >= 90:
        raise InputError(f"the lens does not show all of a marker's face at {place}; move it")
    by_pose = np.concatenate([by_point, -by_point @ cross_matrix(arms)], axis=-1).reshape(8, 6)
    by_intrinsics = camera.parameter_jacobian(p_camera).reshape(8, -1)
    to_pose = np.linalg.pinv(by_pose)
    carried = to_pose @ by_intrinsics
    return PoseError(
        place, T, carried @ covariance @ carried.T, corner_sd_px**2 * to_pose @ to_pose.T
    )


def _worst_deg(covariance: Array) -> float:
    return float(np.degrees(np.sqrt(np.linalg.eigvalsh(covariance[3:, 3:])[-1])))


def _check_positive(**values: float) -> None:
    for name, value in values.items():
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"{name} must be positive, got {value}")
