"""Of detectors and their limits."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Limit:
    """What an engine made of a picture of markers.

    Attributes:
        engine: Its name.
        variable: What is varied.
        value: To what.
        repeat: Which picture.
        expected: How many markers there are.
        found: How many of them it found.
        false_positives: What else it found.
        corner_rms_px: Root mean square error of a corner's coordinate; NaN where none was found.
        bound_px: The least that the noise allows.
        distance2: Mean squared Mahalanobis distance of the corners, about 8 where the stated
            covariance is right; NaN where none is stated.
        position_percent: Median error of the markers' places, of their distances.
        angle_deg: Median error of their rotations.
        flips: How many have the wrong one of two poses.
        failure: Why there is nothing: it crashed, or did not answer; empty where it did.
    """

    engine: str
    variable: str
    value: float
    repeat: int
    expected: int
    found: int
    false_positives: int
    corner_rms_px: float
    bound_px: float
    distance2: float
    position_percent: float
    angle_deg: float
    flips: int
    failure: str
