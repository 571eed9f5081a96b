"""What a calibration is worth: the verdict in words, and a marker's pose at places."""

from dataclasses import dataclass

from tagmetry.calibrate.guidance import Evidence, Verdict, measure, verdict
from tagmetry.calibrate.quality import Place, pose_error
from tagmetry.calibrate.result import Calibration
from tagmetry.errors import InputError
from tagmetry.markers import Board
from tagmetry.record.calibration_report import NamedPoseError

MARKER_M = 0.1  # side of the marker whose pose is judged
_DISTANCES_M = (0.5, 1.0, 2.0)
_SPOTS = {"middle": (0.5, 0.5), "right edge": (0.9, 0.5), "upper left": (0.1, 0.1)}


@dataclass(frozen=True, eq=False)
class Assessment:
    """What a calibration is worth.

    Attributes:
        verdict: In words, with the evidence.
        pose_errors: Of a marker of 0.1 m at places of the image and distances that the lens shows.
    """

    verdict: Verdict
    pose_errors: tuple[NamedPoseError, ...]

    @property
    def evidence(self) -> Evidence:
        """What was measured."""
        return self.verdict.evidence


def assess(calibration: Calibration, board: Board) -> Assessment:
    """Return what a calibration is worth."""
    evidence = measure(calibration, MARKER_M)
    try:
        told = verdict(calibration, board, size_m=MARKER_M, evidence=evidence)
    except InputError:  # the board fits nowhere into the picture: there is no next view
        told = verdict(calibration, size_m=MARKER_M, evidence=evidence)
    return Assessment(told, _pose_errors(calibration))


def _pose_errors(calibration: Calibration) -> tuple[NamedPoseError, ...]:
    width, height = calibration.camera.size_px
    found: list[NamedPoseError] = []
    for name, (across, down) in _SPOTS.items():
        for distance_m in _DISTANCES_M:
            place = Place((across * (width - 1), down * (height - 1)), distance_m)
            try:
                error = pose_error(calibration, MARKER_M, [place])[0]
            except InputError:  # the lens shows no marker there
                continue
            found.append(NamedPoseError(name, MARKER_M, error))
    return tuple(found)
