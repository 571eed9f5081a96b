"""Of a calibration, and of poses along one axis (seed 003)."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """A number that a calibration gives (seed 003, tables 3 to 6).

    Attributes:
        method: Whose calibration.
        repeat: Which of its repeats.
        name: What it is, with its unit unless it is a number of the camera.
        value: What came out.
        true: What it truly is; NaN where there is no truth.
        sd: Its standard deviation as the method states it; NaN where it states none.
    """

    method: str
    repeat: int
    name: str
    value: float
    true: float
    sd: float


@dataclass(frozen=True)
class Position:
    """A marker's coordinate along one axis of the camera (seed 003, tables 7 to 15).

    Attributes:
        method: Whose calibration, detector and pose.
        repeat: Which of the calibrations.
        assumed: What was taken to be true: "right", or what was wrong about it.
        table: Number of the paper's table.
        row: Its row, from 0.
        actual_cm: Where the marker truly is.
        measured_cm: Where it is said to be; NaN where it was not found.
        sd_cm: Standard deviation as the method states it; NaN where it states none.
    """

    method: str
    repeat: int
    assumed: str
    table: int
    row: int
    actual_cm: float
    measured_cm: float
    sd_cm: float
