"""A guided calibration as a value: a view comes, the next state goes.

It knows no camera, clock or disk. Whoever runs it gives each picture's view, what it is like and
when it was taken, shows `outcome`, `next` and `coverage`, and ends when `finished` says why.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from tagmetry.calibrate.guidance.gate import is_blurred, is_repeated, is_unsteady
from tagmetry.calibrate.guidance.knowledge import Knowledge
from tagmetry.calibrate.guidance.next_view import NextView, next_view
from tagmetry.calibrate.guidance.plan import LEAST_VIEWS, Plan
from tagmetry.calibrate.quality.coverage import cells_of
from tagmetry.calibrate.quality.projection import projection_uncertainty
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.targets import ViewQuality
from tagmetry.calibrate.view import BoardView
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import IntArray

_COVERAGE = (8, 6)
_GRID = (9, 7)
_LITTLE = 0.01  # share by which a view must lower the uncertainty to be worth its while
_PATIENCE = 5


@dataclass(frozen=True)
class Outcome:
    """What became of a view.

    Attributes:
        taken: Whether it counts.
        reason: Why not, in words; empty when it does.
    """

    taken: bool
    reason: str = ""


@dataclass(frozen=True, eq=False)
class Session:
    """How far a guided calibration has come.

    Attributes:
        plan: What it is to reach.
        next: Where to hold the board now.
        taken: The views taken.
        calibration: What they give; None while they give none.
        uncertainty_px: After each view taken, the largest standard deviation over the image.
        outcome: What became of the last view.
        last: The last view, taken or not, and when it was seen.
    """

    plan: Plan
    next: NextView
    taken: tuple[BoardView, ...] = ()
    calibration: Calibration | None = None
    uncertainty_px: tuple[float, ...] = ()
    outcome: Outcome = field(default_factory=lambda: Outcome(False, "no picture yet"))
    last: tuple[BoardView, float] | None = None

    @classmethod
    def begin(cls, plan: Plan) -> "Session":
        """Return a session without views.

        Raises:
            InputError: Nowhere within the plan's limits is enough of the board in the picture.
        """
        return cls(plan, next_view(Knowledge.rough(plan.size_px), plan.board, plan.holding))

    @property
    def coverage(self) -> IntArray:
        """How many corners lie in each cell of the image, shape (6, 8)."""
        seen = [view.corners_px for view in self.taken]
        return cells_of(np.concatenate([np.zeros((0, 2)), *seen]), self.plan.size_px, *_COVERAGE)

    @property
    def finished(self) -> str | None:
        """Why nothing more is needed, in words; None while there is."""
        count = len(self.taken)
        if self.calibration is None or count < self.plan.least_views:
            return None
        now = self.uncertainty_px[-1]
        if now <= self.plan.wanted_px:
            return f"reached: {now:.2f} px at the worst place of the image, after {count} views"
        if count >= self.plan.most_views:
            return f"{count} views taken: {now:.2f} px, {self.plan.wanted_px:.2f} px was asked for"
        if _is_stalled(self.uncertainty_px):
            return f"{now:.2f} px: the last {_PATIENCE} views hardly helped"
        return None

    def step(
        self, view: BoardView | str, time_s: float, quality: ViewQuality | None = None
    ) -> "Session":
        """Return the session after a picture.

        Args:
            view: What it shows of the board, or why it shows nothing.
            time_s: When it was taken.
            quality: What it is like around the corners, where that was measured.

        Raises:
            InputError: The picture is of another size than the plan's.
        """
        if isinstance(view, str):
            return replace(self, outcome=Outcome(False, view), last=None)
        self._check_size(view)
        reason = self._refusal(view, time_s, quality)
        seen = replace(self, last=(view, time_s), outcome=Outcome(reason is None, reason or ""))
        return seen if reason else _taken(seen, view)

    def _refusal(self, view: BoardView, time_s: float, quality: ViewQuality | None) -> str | None:
        before, then_s = self.last or (None, time_s)
        gate = self.plan.gate
        return (
            is_unsteady(view, before, time_s - then_s, gate)
            or is_blurred(quality, gate)
            or is_repeated(view, self.taken, gate)
        )

    def _check_size(self, view: BoardView) -> None:
        if view.size_px != self.plan.size_px:
            (width, height), (other_width, other_height) = self.plan.size_px, view.size_px
            raise InputError(
                f"expected pictures of {width}x{height}, got {other_width}x{other_height}; "
                "a calibration holds for one size"
            )


def _taken(session: Session, view: BoardView) -> Session:
    """Return a session with one more view: solved anew, and what to show next."""
    plan, taken = session.plan, (*session.taken, view)
    calibration, known = _known(plan, taken)
    return replace(
        session,
        taken=taken,
        calibration=calibration,
        uncertainty_px=(*session.uncertainty_px, _worst_px(known, calibration)),
        next=next_view(known, plan.board, plan.holding, taken, _distance_m(calibration)),
    )


def _known(plan: Plan, taken: Sequence[BoardView]) -> tuple[Calibration | None, Knowledge]:
    """Return what views tell; without a calibration where they do not determine a camera yet."""
    if len(taken) >= LEAST_VIEWS:
        try:
            calibration = plan.solve(taken)
            return calibration, Knowledge.of_calibration(calibration)
        except InputError:
            pass
    return None, Knowledge.rough(plan.size_px).with_views(taken)


def _worst_px(known: Knowledge, calibration: Calibration | None) -> float:
    if calibration is None:
        return known.worst_px
    return projection_uncertainty(calibration, *_GRID).worst_px


def _distance_m(calibration: Calibration | None) -> float | None:
    """Return where the board was last."""
    if calibration is None:
        return None
    return float(np.linalg.norm(calibration.Ts_camera_board.translation[-1]))


def _is_stalled(uncertainty_px: Sequence[float]) -> bool:
    if len(uncertainty_px) <= _PATIENCE:
        return False
    before, now = uncertainty_px[-1 - _PATIENCE], min(uncertainty_px[-_PATIENCE:])
    return now > before * (1 - _LITTLE) ** _PATIENCE
