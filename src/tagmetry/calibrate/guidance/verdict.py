"""A calibration in words: what it is fit for, what is weak and why, and what to add.

Every sentence carries the number it rests on. A small error on the fitted corners is no evidence:
with few views it is smallest when the camera is worst.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.calibrate.guidance.candidates import HoldingLimits
from tagmetry.calibrate.guidance.doubts import FEW_VIEWS, doubts
from tagmetry.calibrate.guidance.evidence import Evidence, measure
from tagmetry.calibrate.guidance.knowledge import Knowledge
from tagmetry.calibrate.guidance.next_view import NextView, next_view
from tagmetry.calibrate.guidance.words import where
from tagmetry.calibrate.quality.pose_error import PoseError
from tagmetry.calibrate.quality.projection import ProjectionUncertainty
from tagmetry.calibrate.result import Calibration
from tagmetry.markers import Board

_GOOD_PX = 0.5  # at the worst place of the image
_USABLE_PX = 1.5  # at its median place: through a webcam's lens of 600 px, 2.5 mm at a metre
_LIMITS = HoldingLimits()

Grade = Literal["good", "usable", "poor"]


@dataclass(frozen=True, eq=False)
class Verdict:
    """What a calibration is worth.

    Attributes:
        words: The whole of it in a few sentences.
        grade: "good": within 0.5 px everywhere on the image, by eight views or more; "usable":
            within 1.5 px on half of it; "poor": neither.
        fit_for: What it can be used for, each with the number that says so.
        warnings: What is weak and why, the worst first; they contain what the calibration warns of.
        next_view: The picture to add that helps most; None where no board was given, or none fits.
        evidence: What all this rests on.
    """

    words: str
    grade: Grade
    fit_for: tuple[str, ...]
    warnings: tuple[str, ...]
    next_view: NextView | None
    evidence: Evidence


def verdict(
    calibration: Calibration,
    board: Board | None = None,
    *,
    size_m: float = 0.05,
    limits: HoldingLimits = _LIMITS,
    evidence: Evidence | None = None,
) -> Verdict:
    """Return what a calibration is worth, in words.

    Args:
        calibration: What was solved.
        board: What was seen, for the picture to add.
        size_m: Side of the marker whose pose is to be measured.
        limits: How the board can be held.
        evidence: What was measured of it already; None measures it.

    Raises:
        InputError: The calibration has no covariance; no place shows enough of the board.
    """
    evidence = evidence or measure(calibration, size_m)
    grade = _grade(evidence, len(calibration.views))
    fit_for, weak = _fit_for(evidence), doubts(calibration, evidence)
    added = _next_view(calibration, board, limits) if board else None
    words = _words(calibration, evidence, grade, weak, added)
    return Verdict(words, grade, fit_for, weak, added, evidence)


def _grade(evidence: Evidence, views: int) -> Grade:
    uncertainty = evidence.uncertainty
    if _is_good_everywhere(uncertainty) and views >= FEW_VIEWS:
        return "good"
    return "usable" if uncertainty.middle_px <= _USABLE_PX else "poor"


def _is_good_everywhere(uncertainty: ProjectionUncertainty) -> bool:
    return uncertainty.worst_px <= _GOOD_PX and uncertainty.unshown_share == 0


def _fit_for(evidence: Evidence) -> tuple[str, ...]:
    """Return uses, each with its number."""
    uncertainty, found = evidence.uncertainty, []
    share = float((np.nan_to_num(uncertainty.sd_px, nan=np.inf) <= _GOOD_PX).mean())
    if _is_good_everywhere(uncertainty):
        found.append(
            "measuring anywhere on the image, and straightening it: projections are within "
            f"{uncertainty.worst_px:.2f} px (one standard deviation) at the worst place"
        )
    elif share > 0.1:
        found.append(
            f"measuring on {share:.0%} of the image, where projections are within {_GOOD_PX} px "
            "(one standard deviation)"
        )
    if uncertainty.middle_px <= _USABLE_PX:
        found.append(f"the pose of {_pose_words(evidence.middle, evidence.size_m)}")
    return tuple(found)


def _pose_words(pose: PoseError, size_m: float) -> str:
    place = pose.place
    return (
        f"a marker of {size_m * 1e3:.0f} mm in the middle of the image, {place.distance_m:.2g} m "
        f"away: the calibration adds {pose.worst_mm:.2g} mm and {pose.worst_deg:.2g} degrees (one "
        "standard deviation)"
    )


def _next_view(calibration: Calibration, board: Board, limits: HoldingLimits) -> NextView:
    last_m = float(np.linalg.norm(calibration.Ts_camera_board.translation[-1]))
    known = Knowledge.of_calibration(calibration)
    return next_view(known, board, limits, calibration.views, last_m)


def _words(
    calibration: Calibration,
    evidence: Evidence,
    grade: Grade,
    weak: tuple[str, ...],
    added: NextView | None,
) -> str:
    uncertainty = evidence.uncertainty
    place = where(uncertainty.worst_pixel, calibration.camera.size_px)
    sentences = [
        (
            f"{grade.capitalize()}: {len(calibration.views)} views leave projections uncertain by "
            f"{uncertainty.middle_px:.2f} px at a middling place of the image and by "
            f"{uncertainty.worst_px:.2f} px {place} (one standard deviation)"
        )
    ]
    if evidence.left_out:
        sentences.append(_left_out_words(evidence.left_out.rms_px, calibration.rms_px))
    if weak:
        sentences.append(f"Above all: {weak[0]}")
    if added:
        sentences.append(f"To better it most, {added.text}{_expected(added)}")
    return ". ".join(sentences) + "."


def _left_out_words(left_out_px: float, fitted_px: float) -> str:
    if not np.isfinite(left_out_px):
        return "Without some of its views there is no camera: they hang on each other"
    return (
        f"Views that were left out are shown within {left_out_px:.3f} px, those fitted within "
        f"{fitted_px:.3f} px"
    )


def _expected(added: NextView) -> str:
    share = added.expected_px / added.now_px
    return f"; the largest uncertainty is then expected to fall to {share:.0%}"
