"""All that a verdict on a calibration rests on, measured once."""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.quality.coverage import Coverage, coverage
from tagmetry.calibrate.quality.halves import SplitHalves, split_halves
from tagmetry.calibrate.quality.hold_out import HoldOut, hold_out
from tagmetry.calibrate.quality.influence import ViewInfluence, view_influence
from tagmetry.calibrate.quality.places import Place
from tagmetry.calibrate.quality.pose_error import PoseError, pose_error
from tagmetry.calibrate.quality.projection import ProjectionUncertainty, projection_uncertainty
from tagmetry.calibrate.quality.residuals import ResidualField, residual_field
from tagmetry.calibrate.result import Calibration
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_INWARD = 0.1  # of the image: so far from its edges a marker at the corner has its centre


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was measured of a calibration; None where the views are too few to tell.

    Attributes:
        uncertainty: Over the image, far away.
        left_out: Errors on left-out views.
        halves: How the cameras of two halves of the views differ.
        residuals: What the errors have in common.
        coverage: What the views show.
        influence: How much each view decides.
        middle: Pose of a marker in the middle of the image.
        corner: Pose of the same near the image's corner where it is worst; None where the lens
            shows no whole marker near any.
        size_m: Side of that marker.
    """

    uncertainty: ProjectionUncertainty
    left_out: HoldOut | None
    halves: SplitHalves | None
    residuals: ResidualField
    coverage: Coverage
    influence: ViewInfluence
    middle: PoseError
    corner: PoseError | None
    size_m: float


def measure(calibration: Calibration, size_m: float = 0.05) -> Evidence:
    """Return what there is to say of a calibration.

    Args:
        calibration: What was solved.
        size_m: Side of the marker whose pose is looked at, seen from 20 times as far.

    Raises:
        InputError: The size is not positive, or the calibration has no covariance.
    """
    count, camera = len(calibration.views), calibration.camera
    middle = Place(((camera.width_px - 1) / 2, (camera.height_px - 1) / 2), 20 * size_m)
    corners = [Place((u, v), 20 * size_m) for u, v in _near_corners(camera)]
    at_corners = [found for place in corners if (found := _pose(calibration, size_m, place))]
    return Evidence(
        uncertainty=projection_uncertainty(calibration),
        left_out=hold_out(calibration) if count >= 4 else None,
        halves=split_halves(calibration) if count >= 6 else None,
        residuals=residual_field(calibration),
        coverage=coverage(calibration),
        influence=view_influence(calibration),
        middle=pose_error(calibration, size_m, [middle])[0],
        corner=max(at_corners, key=lambda found: found.worst_mm, default=None),
        size_m=size_m,
    )


def _near_corners(camera: Camera) -> Array:
    across = np.array([_INWARD, 1 - _INWARD]) * (camera.width_px - 1)
    down = np.array([_INWARD, 1 - _INWARD]) * (camera.height_px - 1)
    return np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2)


def _pose(calibration: Calibration, size_m: float, place: Place) -> PoseError | None:
    """Return the pose's error, None where the lens shows no whole marker."""
    try:
        return pose_error(calibration, size_m, [place])[0]
    except InputError:
        return None
