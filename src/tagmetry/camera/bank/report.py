"""What a bank says about itself."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LeftOut:
    """How far a calibration is from what its neighbours predict without it.

    Both its own error and the interpolation's, over twice the usual gap, are in it.

    Attributes:
        width_px: Columns of its images.
        height_px: Rows.
        zoom: Its zoom.
        focus: Its focus.
        focal_percent: Predicted less calibrated focal length, the mean of fx and fy.
        center_px: Distance of the two principal points.
        worst_px: Largest distance of two pixels that show one ray, over the image.
    """

    width_px: int
    height_px: int
    zoom: float
    focus: float
    focal_percent: float
    center_px: float
    worst_px: float


@dataclass(frozen=True)
class Gap:
    """Two neighbouring calibrations that are farther apart than asked for.

    Attributes:
        width_px: Columns of their images.
        height_px: Rows.
        zoom: Their zoom.
        low_focus: The lower focus.
        high_focus: The higher one.
        focal_sd_percent: Standard deviation of the focal length half way, of the length itself;
            None where a calibration states none.
    """

    width_px: int
    height_px: int
    zoom: float
    low_focus: float
    high_focus: float
    focal_sd_percent: float | None


@dataclass(frozen=True)
class Repeat:
    """Several calibrations at one setting, and how well they agree.

    Attributes:
        width_px: Columns of their images.
        height_px: Rows.
        zoom: Their zoom.
        focus: Their focus.
        count: How many there are.
        worst_px: Largest distance over the image between one of them and their mean.
        excess: Chi-square per degree of freedom about the mean; near 1 when their covariances
            are right, None where one has none. Above 1, the mean's covariance is scaled by it.
        hysteresis_px: Largest distance over the image between those from near and those from far,
            None unless both are there.
    """

    width_px: int
    height_px: int
    zoom: float
    focus: float
    count: int
    worst_px: float
    excess: float | None
    hysteresis_px: float | None
