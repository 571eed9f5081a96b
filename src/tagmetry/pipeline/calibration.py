"""Pictures of a board to a calibration, and all that tells what it is worth.

pictures -> views, or why there is none -> the views that tell most -> a first camera
    -> the views as it shows their corners -> camera -> quality
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from tagmetry.calibrate.choice import LensModel
from tagmetry.calibrate.doctor import (
    BoardAdvice,
    check_measured,
    check_print_aspect,
    diagnose_board,
)
from tagmetry.calibrate.guidance import most_informative
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.errors import InputError
from tagmetry.files.board_text import board_text
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import Board
from tagmetry.pipeline.assessment import Assessment, assess
from tagmetry.pipeline.board_pictures import Sighting, looked_again
from tagmetry.record.calibration_report import CalibrationFacts

MOST_VIEWS = 100  # of a long video, where nothing else was asked for
_LEAST_VIEWS = 3


@dataclass(frozen=True)
class Request:
    """What is asked for.

    Attributes:
        board: The board that the pictures show.
        model: The lens, or "auto".
        free_shape: The board's points may leave the maker's places.
        fix_aspect: fx = fy.
        fix_center: The principal point is the image's centre.
        most_views: Solve from so many views, those that tell most.
        measured_m: Lengths of the printed board by a ruler, see `calibrate.doctor.SPANS`.
    """

    board: Board
    model: LensModel = "auto"
    free_shape: bool = False
    fix_aspect: bool = False
    fix_center: bool = False
    most_views: int = MOST_VIEWS
    measured_m: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check_measured(self.board, self.measured_m)  # refuses lengths that the board does not have
        if self.most_views < _LEAST_VIEWS:
            raise InputError(
                f"a calibration needs at least {_LEAST_VIEWS} views, asked for {self.most_views}"
            )


@dataclass(frozen=True, eq=False)
class CalibrationRun:
    """A calibration with all that belongs to it.

    Attributes:
        request: What was asked for.
        calibration: The camera and how it came about.
        assessment: What it is worth.
        rejected: Every picture that took no part, and why.
        thumbnails: Of the views that were used, in their order.
        advice: What is odd about the board.
    """

    request: Request
    calibration: Calibration
    assessment: Assessment
    rejected: tuple[RejectedView, ...]
    thumbnails: tuple[GreyPixels, ...]
    advice: tuple[BoardAdvice, ...] = ()

    @property
    def facts(self) -> CalibrationFacts:
        """What a report tells of it."""
        return CalibrationFacts(
            board_text(self.request.board),
            self.calibration,
            self.assessment.verdict,
            self.assessment.pose_errors,
            self.rejected,
            self.thumbnails,
            tuple(advice_line(one) for one in self.advice),
        )


class RefusedError(InputError):
    """No calibration can be had from these pictures.

    Attributes:
        rejected: The pictures that showed nothing usable, and why.
        advice: What the board seems to be instead.
    """

    def __init__(
        self, text: str, rejected: Sequence[RejectedView] = (), advice: Sequence[BoardAdvice] = ()
    ) -> None:
        super().__init__(text)
        self.rejected, self.advice = tuple(rejected), tuple(advice)


def advice_line(advice: BoardAdvice) -> str:
    """Return what the board doctor says, with the board to ask for instead."""
    if advice.board is None:
        return str(advice)
    return f"{advice}; ask for --board {board_text(advice.board)}"


def run_calibration(seen: Sequence[Sighting], request: Request) -> CalibrationRun:
    """Return the calibration that sightings of a board give.

    Raises:
        RefusedError: They give none; it says why, and what the board seems to be instead.
    """
    rejected = tuple(one.result for one in seen if isinstance(one.result, RejectedView))
    advice = (*_advice(seen, request.board), *check_measured(request.board, request.measured_m))
    try:
        chosen, spare = _chosen(_views(seen), request.most_views)
        first = _solved(chosen, request)
        again = looked_again(seen, first, request.board)
        calibration = _solved(_views(again), request)
    except InputError as error:
        raise RefusedError(str(error), rejected, advice) from error
    thumbnails = {id(one.result): one.thumbnail for one in again}
    return CalibrationRun(
        request,
        calibration,
        assess(calibration, request.board),
        (*rejected, *first.rejected, *calibration.rejected, *spare),
        tuple(thumbnails[id(view)] for view in calibration.views),
        (*advice, *check_print_aspect(calibration)),
    )


def with_provenance(run: CalibrationRun, board: str, program: str, when: str) -> CalibrationRun:
    """Return the run, its camera saying where it comes from.

    Args:
        run: The calibration.
        board: The board in one line.
        program: Name and version of the program.
        when: The date.
    """
    solved = run.calibration
    told = f"{program}, {when}: {len(solved.views)} views of {board}, rms {solved.rms_px:.3f} px"
    left_out = run.assessment.evidence.left_out
    if left_out is not None and np.isfinite(left_out.rms_px):
        told += f", on left-out views {left_out.rms_px:.3f} px"
    return replace(run, calibration=replace(solved, camera=replace(solved.camera, provenance=told)))


def _views(seen: Sequence[Sighting]) -> list[BoardView]:
    return [one.result for one in seen if isinstance(one.result, BoardView)]


def _solved(views: Sequence[BoardView], request: Request) -> Calibration:
    return calibrate(
        views,
        request.model,
        shape="free" if request.free_shape else "flat",
        fix_aspect=request.fix_aspect,
        fix_center=request.fix_center,
    )


def _chosen(
    views: Sequence[BoardView], most: int
) -> tuple[list[BoardView], tuple[RejectedView, ...]]:
    """Return the views to solve from, in their order, and those that are not needed."""
    if len(views) <= most:
        return list(views), ()
    kept = set(most_informative(views, most))
    if len(kept) < _LEAST_VIEWS:  # they are all alike: whoever solves says so
        return list(views[:most]), ()
    reason = f"the {len(kept)} views that were taken tell more"
    spare = [RejectedView(v.source, reason) for i, v in enumerate(views) if i not in kept]
    return [view for i, view in enumerate(views) if i in kept], tuple(spare)


def _advice(seen: Sequence[Sighting], board: Board) -> tuple[BoardAdvice, ...]:
    pictures = [one.pixels for one in seen if one.pixels is not None]
    return diagnose_board(pictures, board)
