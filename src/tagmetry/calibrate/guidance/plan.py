"""What a guided calibration is to reach."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from tagmetry.calibrate.guidance.candidates import HoldingLimits
from tagmetry.calibrate.guidance.gate import GateLimits
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.view import BoardView
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.errors import InputError
from tagmetry.markers import Board

LEAST_VIEWS = 3  # fewer make no calibration

Solver = Callable[[Sequence[BoardView]], Calibration]


def solve_five(views: Sequence[BoardView]) -> Calibration:
    """Return the calibration with five coefficients: quick, and enough to guide."""
    return calibrate(views, "brown5")


@dataclass(frozen=True, eq=False)
class Plan:
    """What a session is to reach.

    Attributes:
        board: The board.
        size_px: (width, height) of the pictures.
        wanted_px: Largest standard deviation of projections over the image to be reached.
        least_views: Before that many nothing is finished.
        most_views: After that many it is.
        gate: What a view must keep to be taken.
        holding: How the board can be held.
        solve: Views to a calibration.
    """

    board: Board
    size_px: tuple[int, int]
    wanted_px: float = 0.5
    least_views: int = 10
    most_views: int = 60
    gate: GateLimits = field(default_factory=GateLimits)
    holding: HoldingLimits = field(default_factory=HoldingLimits)
    solve: Solver = solve_five

    def __post_init__(self) -> None:
        if not self.wanted_px > 0:
            raise InputError(f"wanted_px must be positive, got {self.wanted_px}")
        if not LEAST_VIEWS <= self.least_views <= self.most_views:
            raise InputError(
                f"expected {LEAST_VIEWS} <= least_views <= most_views, got {self.least_views} and "
                f"{self.most_views}"
            )
