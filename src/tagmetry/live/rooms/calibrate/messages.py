"""What the calibration room and the page say to each other."""

from dataclasses import dataclass
from typing import Literal

Phase = Literal["looking", "solving", "done", "failed"]


@dataclass(frozen=True)
class CalibrationPicture:
    """What the camera to be calibrated sees.

    Attributes:
        width_px: Of the picture as it is sent.
        height_px: Of the picture as it is sent.
        corners_px: Of the board that was found in it; empty where none was.
        outline_px: Where the board's edge is wanted next, clockwise; null where the lens shows
            nothing.
        jpeg: The picture's file; it goes behind the JSON of the others.
    """

    width_px: int
    height_px: int
    corners_px: tuple[tuple[float, float], ...]
    outline_px: tuple[tuple[float, float], ...]
    jpeg: bytes


@dataclass(frozen=True)
class CalibrationNumber:
    """A number of the camera.

    Attributes:
        name: `fx`, `cx`, `k1` and so on.
        value: In pixels, or without a unit.
        sd: Its standard deviation.
    """

    name: str
    value: float
    sd: float


@dataclass(frozen=True)
class CalibrationResult:
    """A camera, and what it is worth.

    Attributes:
        lens: Its model.
        numbers: What was solved.
        rms_px: Error of the views that it rests on.
        hold_out_px: Error of views that were left out in turn.
        worst_px: Largest standard deviation of projections over the image.
        grade: good, usable or poor.
        words: The verdict in sentences.
        fit_for: What the camera can be used for.
        doubts: What is weak, the worst first.
        has_report: There is a report to download.
    """

    lens: str
    numbers: tuple[CalibrationNumber, ...]
    rms_px: float
    hold_out_px: float
    worst_px: float
    grade: str
    words: str
    fit_for: tuple[str, ...]
    doubts: tuple[str, ...]
    has_report: bool


@dataclass(frozen=True)
class CalibrationState:
    """How far the calibration is.

    Attributes:
        phase: What goes on; `failed` says why in `why`.
        camera: That is calibrated.
        board: In one line.
        wanted_px: Uncertainty to be reached at the worst place of the image.
        advice: What to do now, in words.
        why: Why the newest image was not taken, or what failed; empty where nothing did.
        uncertainty_px: At the worst place of the image, after each view taken.
        coverage: How many corners were seen in each cell of the image, 6 rows of 8.
        result: The camera; None before it is solved.
        saved: Name of the files that it was saved as; empty before.
    """

    phase: Phase
    camera: str
    board: str
    wanted_px: float
    advice: str = ""
    why: str = ""
    uncertainty_px: tuple[float, ...] = ()
    coverage: tuple[tuple[int, ...], ...] = ()
    result: CalibrationResult | None = None
    saved: str = ""


@dataclass(frozen=True)
class StartCalibration:
    """Look at a board and take views of it.

    Attributes:
        board: In one line, like `charuco:7x5:30mm:22mm:5x5_100`.
        uncertainty: To be reached at the worst place of the image, like `0.5px`.
    """

    board: str
    uncertainty: str


@dataclass(frozen=True)
class EndCalibration:
    """Take no more views, and solve from those that were taken."""


@dataclass(frozen=True)
class SaveCalibration:
    """Write the camera's file and its report into the server's folder.

    Attributes:
        name: Of the files, without a suffix: letters, digits, - and _.
    """

    name: str
