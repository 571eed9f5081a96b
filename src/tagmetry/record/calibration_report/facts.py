"""What a report tells: the calibration and all that was measured of it."""

from dataclasses import dataclass

from tagmetry.calibrate.guidance import Evidence, Verdict
from tagmetry.calibrate.quality import PoseError
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.view import RejectedView
from tagmetry.geometry.arrays import GreyPixels


@dataclass(frozen=True, eq=False)
class NamedPoseError:
    """How wrong a marker's pose is at a place.

    Attributes:
        name: The place in the image, in words.
        size_m: Side of the marker.
        error: The pose's error there.
    """

    name: str
    size_m: float
    error: PoseError


@dataclass(frozen=True, eq=False)
class CalibrationFacts:
    """A calibration and what is known of it.

    Attributes:
        board: The board in one line.
        calibration: The camera and how it came about.
        verdict: What it is worth, in words, with the evidence.
        pose_errors: Of a marker at places.
        rejected: The pictures that took no part, and why.
        thumbnails: Of the views that were used, small and grey.
        remarks: What is odd about the board, in words.
    """

    board: str
    calibration: Calibration
    verdict: Verdict
    pose_errors: tuple[NamedPoseError, ...]
    rejected: tuple[RejectedView, ...]
    thumbnails: tuple[GreyPixels, ...]
    remarks: tuple[str, ...] = ()

    @property
    def evidence(self) -> Evidence:
        """What was measured."""
        return self.verdict.evidence
