"""A marker's pose with all that it is unsure of: noise, model, calibration and size.

The corners' own covariance holds the image's noise. To it are added what no fit of so few pixels
can know (`accuracy`), and the errors of calibration, size and a blur that is not the same all over
the marker, carried to the pose (`corner_errors`). Where the other of a flat marker's
two poses is possible too, the way to it counts with its probability.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens.accuracy import DESCRIBED_PX, unmodelled_px
from tagmetry.lens.corner_errors import CornerErrors
from tagmetry.lens.readable import MarkerKind
from tagmetry.lens.setting import LensSetting
from tagmetry.lens.zoom_lens import ZoomLens
from tagmetry.pose import MarkerPose, estimate_pose


@dataclass(frozen=True, eq=False)
class Measured:
    """One measurement of one marker.

    Attributes:
        setting: The zoom and focus that it was taken at.
        seen: Where the detector found it; its covariance is of the noise alone.
        detection: The same, with what no noise tells in its covariance.
        pose: Both hypotheses, with the corners' part of the covariance.
        covariance: Of the best hypothesis with everything in it, shape (6, 6), (translation,
            rotation vector) on the left in the camera frame, m and rad.
        blur_px: Standard deviation of its blur in the image; NaN where it was not measured.
        images: How many images it is the mean of.
    """

    setting: LensSetting
    seen: Detection
    detection: Detection
    pose: MarkerPose
    covariance: Array
    blur_px: float
    images: int = 1

    @property
    def T_camera_marker(self) -> RigidTransform:  # noqa: N802 (frames are named so)
        """The best pose."""
        return self.pose.best.T_camera_marker

    @property
    def depth_m(self) -> float:
        """Depth along the camera's axis."""
        return float(self.T_camera_marker.translation[2])

    @property
    def depth_sd_m(self) -> float:
        """Its standard deviation."""
        return float(np.sqrt(self.covariance[2, 2]))

    @property
    def turn_sd_rad(self) -> float:
        """Standard deviation of the rotation about its least certain axis."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance[3:, 3:])[-1]))

    @cached_property
    def tilt_rad(self) -> float:
        """Angle between the view and the marker's normal."""
        p_camera = np.asarray(self.T_camera_marker.translation)
        normal = self.T_camera_marker.rotation.as_matrix()[:, 2]
        cosine = -normal @ p_camera / np.linalg.norm(p_camera)
        return float(np.arccos(np.clip(cosine, -1, 1)))


def measured(
    detection: Detection,
    lens: ZoomLens,
    marker: MarkerKind,
    setting: LensSetting,
    blur_px: float = float("nan"),
) -> Measured | None:
    """Return the pose of a marker seen at a setting; None where its corners are no marker's.

    Args:
        detection: Its corners.
        lens: The camera, with its bank.
        marker: Its size.
        setting: What the image was taken at.
        blur_px: Its blur, see `marker_blur_px`; where it is not known it is taken to be sharp.
    """
    camera = lens.camera_at(setting)
    known = _with_model_error(detection, lens, marker, setting, blur_px)
    pose = estimate_pose(known, camera, marker.size_m)
    if not pose.hypotheses:
        return None
    errors = CornerErrors(pose.best.T_camera_marker, known.corners_cov_px2, camera, marker)
    covariance = pose.covariance + errors.of_calibration() + errors.of_size()
    covariance = covariance + errors.of_uneven_blur(lens, setting) + _of_alternatives(pose)
    return Measured(setting, detection, known, pose, covariance, blur_px)


def _with_model_error(
    detection: Detection, lens: ZoomLens, marker: MarkerKind, setting: LensSetting, blur_px: float
) -> Detection:
    """Return the detection with what no noise tells added to its corners' covariance."""
    resolved_per_px = min(1.0, lens.native_percent / setting.zoom_percent)
    side_px = _least_extent_px(detection)
    depth_m = lens.focal_px(setting.magnification) * marker.size_m / detection.side_px
    defocus_px = lens.blur_of_depth_px(setting, depth_m) / 4
    if np.isfinite(blur_px):
        defocus_px = max(defocus_px, blur_px) if blur_px > DESCRIBED_PX else defocus_px
    error_px = unmodelled_px(
        side_px * resolved_per_px, marker.side_cells, defocus_px, resolved_per_px
    )
    error_px /= resolved_per_px
    more_px2 = error_px**2 * np.eye(8)
    return replace(detection, corners_cov_px2=detection.corners_cov_px2 + more_px2)


def _least_extent_px(detection: Detection) -> float:
    """Return the root of the marker's area: its side, foreshortened half as much."""
    x, y = detection.corners_px.T
    area_px2 = 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))
    return max(float(np.sqrt(area_px2)), 1.0)


def _of_alternatives(pose: MarkerPose) -> Array:
    """Return the mean square of the way to the other hypothesis."""
    covariance = np.zeros((6, 6))
    for other in pose.alternatives:
        way = pose_difference(pose.best.T_camera_marker, other.T_camera_marker)
        covariance += other.probability * np.outer(way, way)
    return covariance


def turn_about_y_deg(T_camera_marker: RigidTransform) -> float:
    """Return the angle phi of seed 000: a facing marker's turn about its upright axis."""
    R_camera_facing = T_camera_marker.rotation * Rotation.from_euler("x", 180, degrees=True)
    normal = R_camera_facing.as_matrix()[:, 2]
    return float(np.degrees(np.arctan2(normal[0], normal[2])))
