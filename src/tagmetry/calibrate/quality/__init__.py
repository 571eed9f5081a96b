"""What a calibration is worth: errors on left-out views, uncertainty over the image, coverage."""

from tagmetry.calibrate.quality.coverage import Coverage, coverage
from tagmetry.calibrate.quality.halves import SplitHalves, camera_difference_px, split_halves
from tagmetry.calibrate.quality.hold_out import HoldOut, hold_out
from tagmetry.calibrate.quality.influence import ViewInfluence, view_influence
from tagmetry.calibrate.quality.places import Place, poses_at
from tagmetry.calibrate.quality.pose_error import PoseError, pose_error
from tagmetry.calibrate.quality.projection import ProjectionUncertainty, projection_uncertainty
from tagmetry.calibrate.quality.residuals import MeanErrors, ResidualField, residual_field

__all__ = [
    "Coverage",
    "HoldOut",
    "MeanErrors",
    "Place",
    "PoseError",
    "ProjectionUncertainty",
    "ResidualField",
    "SplitHalves",
    "ViewInfluence",
    "camera_difference_px",
    "coverage",
    "hold_out",
    "pose_error",
    "poses_at",
    "projection_uncertainty",
    "residual_field",
    "split_halves",
    "view_influence",
]
