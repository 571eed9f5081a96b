"""How exact a marker's pose will be: what corners, calibration and size do to it, apart.

With J_p and J_c the derivatives of the corners' pixels by the pose and by the intrinsics, and C the
covariance that the detector's corners will have,

    dp = (J_p^T C^-1 J_p)^-1 J_p^T C^-1 (noise - J_c dc)      and      dt = t dsize / size,

so that the three parts add up. Averaging pictures makes the first smaller, and not the others.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.photometric.bound import detector_covariance_px2
from tagmetry.errors import InputError
from tagmetry.geometry import Array, cross_matrix
from tagmetry.pose.plan.flips import flip_probability
from tagmetry.pose.plan.setup import Setup

_LEAST_SIDE_PX = 2.0


@dataclass(frozen=True, eq=False)
class Prediction:
    """How exact a pose will be. All covariances are on the left in the camera frame, m and rad.

    Attributes:
        setup: Of what.
        corners_cov_px2: Covariance of the corners, shape (8, 8).
        by_corners: Covariance of the pose by the noise of one picture, shape (6, 6).
        by_calibration: By the calibration; None where the camera states no covariance.
        by_size: By what is not known of the marker's size.
        flip_probability: That the wrong one of two poses fits better, 0 to 0.5.
    """

    setup: Setup
    corners_cov_px2: Array
    by_corners: Array
    by_calibration: Array | None
    by_size: Array
    flip_probability: float

    @property
    def covariance(self) -> Array:
        """All that is known, shape (6, 6)."""
        known = self.by_corners + self.by_size
        return known if self.by_calibration is None else known + self.by_calibration

    @property
    def position_m(self) -> float:
        """Root mean square distance from the true place."""
        return position_m(self.covariance)

    @property
    def angle_rad(self) -> float:
        """Root mean square angle of rotation from the true orientation, unless it is flipped."""
        return angle_rad(self.covariance)

    @property
    def corner_px(self) -> float:
        """Root mean square error of a corner along an axis."""
        return float(np.sqrt(np.trace(self.corners_cov_px2) / 8))


def predict(setup: Setup) -> Prediction:
    """Return how exact the pose of a marker will be.

    Raises:
        InputError: The image does not show all of the marker, or hardly shows it.
    """
    _check_seen(setup)
    corners_cov_px2 = detector_covariance_px2(
        setup.corners_px, setup.printed, setup.imaging.all_noise_grey
    )
    by_pose, by_intrinsics = _derivatives(setup)
    information = by_pose.T @ np.linalg.inv(corners_cov_px2)
    by_corners = np.asarray(np.linalg.inv(information @ by_pose))
    carried = by_corners @ information @ by_intrinsics
    known = setup.camera.covariance
    return Prediction(
        setup,
        corners_cov_px2,
        by_corners,
        None if known is None else carried @ known @ carried.T,
        _by_size(setup),
        flip_probability(setup, corners_cov_px2),
    )


def _check_seen(setup: Setup) -> None:
    side_px, motion_px = setup.short_side_px, float(np.hypot(*setup.motion_px))
    name = f"a marker of {1000 * setup.size_m:g} mm at {setup.distance_m:g} m"
    if not setup.fits:
        raise InputError(
            f"the image does not show all of {name}; move it away or to the middle, or take a "
            "smaller one"
        )
    if side_px < _LEAST_SIDE_PX:
        raise InputError(f"{name} has {side_px:.2g} px in the image, too few to tell anything")
    if motion_px > side_px:
        raise InputError(
            f"{name} moves {motion_px:.3g} px while the shutter is open, farther than its side; "
            "expose for a shorter time"
        )


def position_m(covariance: Array) -> float:
    """Return the root mean square distance that a pose's covariance (6, 6) means."""
    return float(np.sqrt(np.trace(covariance[:3, :3])))


def angle_rad(covariance: Array) -> float:
    """Return the root mean square angle that a pose's covariance (6, 6) means."""
    return float(np.sqrt(np.trace(covariance[3:, 3:])))


def _derivatives(setup: Setup) -> tuple[Array, Array]:
    """Return those of the corners' pixels by the pose, (8, 6), and by the intrinsics, (8, c)."""
    arms = setup.p_camera - np.asarray(setup.T_camera_marker.translation)
    _, by_point = setup.camera.project_with_jacobian(setup.p_camera)
    by_pose = np.concatenate([by_point, -by_point @ cross_matrix(arms)], axis=-1)
    return by_pose.reshape(8, 6), setup.camera.parameter_jacobian(setup.p_camera).reshape(8, -1)


def _by_size(setup: Setup) -> Array:
    off_m = np.asarray(setup.T_camera_marker.translation) * setup.size_sd_m / setup.size_m
    change = np.concatenate([off_m, np.zeros(3)])
    return np.outer(change, change)
