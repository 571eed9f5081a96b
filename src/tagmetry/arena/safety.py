"""When a robot has to stop: decisions as values, for whoever talks to the robots.

A robot stops while it is not seen, while it is outside its fence, and while the stop for all is
pressed. That stop is latched: it stays until it is reset on purpose.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from tagmetry.arena.robot import Robot
from tagmetry.arena.world_state import RobotState, WorldState
from tagmetry.errors import InputError
from tagmetry.geometry import Array

StopReason = Literal[
    "stop for all", "never seen", "not seen", "outside the fence", "controller", "disobeys"
]


@dataclass(frozen=True)
class Fence:
    """A polygon that robots stay in.

    Attributes:
        corners_m: (x, y) of its corners in the world, in order, at least three.
    """

    corners_m: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        corners = np.array(self.corners_m, dtype=np.float64)
        if corners.ndim != 2 or corners.shape[0] < 3 or corners.shape[1] != 2:
            raise InputError(f"a fence has three corners (x, y) or more, got {self.corners_m}")
        if not np.isfinite(corners).all() or abs(_area_m2(corners)) < 1e-6:
            raise InputError(f"a fence needs finite corners round an area, got {self.corners_m}")

    def inside_m(self, place: Array) -> float:
        """Return how far a place (x, y) is inside the fence; negative outside."""
        corners = np.array(self.corners_m)
        ends = np.roll(corners, -1, axis=0)
        along = ends - corners
        lengths2 = np.maximum((along**2).sum(axis=1), 1e-300)
        share = np.clip(((place - corners) * along).sum(axis=1) / lengths2, 0, 1)
        away_m = float(np.hypot(*(corners + share[:, None] * along - place).T).min())
        return away_m if _is_inside(corners, ends, place) else -away_m


@dataclass(frozen=True)
class SafetyRules:
    """What robots are stopped for.

    Attributes:
        unseen_s: After so long without being seen.
        fence: Where they stay; anywhere when None.
        margin_m: How far from the fence a robot's rim stops.
    """

    unseen_s: float = 0.5
    fence: Fence | None = None
    margin_m: float = 0.0

    def __post_init__(self) -> None:
        if not 0 < self.unseen_s < np.inf:
            raise InputError(f"unseen_s must be positive, got {self.unseen_s}")
        if not np.isfinite(self.margin_m):
            raise InputError(f"margin_m must be finite, got {self.margin_m}")


@dataclass(frozen=True)
class StopForAll:
    """The stop for all robots, which stays pressed until it is reset.

    Attributes:
        is_pressed: Whether all have to stop.
        why: Who or what pressed it.
        time_s: When it was pressed first.
    """

    is_pressed: bool = False
    why: str = ""
    time_s: float = 0.0

    def pressed(self, why: str, time_s: float) -> "StopForAll":
        """Return it pressed; pressed once, it keeps its first reason."""
        return self if self.is_pressed else replace(self, is_pressed=True, why=why, time_s=time_s)

    def reset(self) -> "StopForAll":
        """Return it released."""
        return StopForAll()


@dataclass(frozen=True)
class Decision:
    """Whether a robot may drive.

    Attributes:
        robot_id: Which robot.
        reasons: Why it has to stop; none where it may drive.
        told: The reasons in words, with numbers.
    """

    robot_id: int
    reasons: tuple[StopReason, ...] = field(default=())
    told: str = ""

    @property
    def must_stop(self) -> bool:
        """Whether there is a reason."""
        return bool(self.reasons)


def decide(
    world: WorldState, robots: Sequence[Robot], rules: SafetyRules, stop: StopForAll
) -> tuple[Decision, ...]:
    """Return for every robot whether it may drive.

    Args:
        world: Where the robots are now.
        robots: All that there are, seen or not.
        rules: What they are stopped for.
        stop: The stop for all.
    """
    by_id = {state.id: state for state in world}
    return tuple(_decided(robot, by_id.get(robot.id), rules, stop) for robot in robots)


def _decided(
    robot: Robot, state: RobotState | None, rules: SafetyRules, stop: StopForAll
) -> Decision:
    found: list[tuple[StopReason, str]] = []
    if stop.is_pressed:
        found.append(("stop for all", f"stop for all: {stop.why}"))
    if state is None:
        found.append(("never seen", "there is no track of it"))
    elif not state.age_s <= rules.unseen_s:
        found.append(("not seen", f"not seen for {state.age_s:.2f} s"))
    if state is not None and rules.fence is not None:
        place = np.array([state.x_m, state.y_m])
        left_m = rules.fence.inside_m(place) - robot.radius_m - rules.margin_m
        if not left_m >= 0:
            found.append(("outside the fence", f"{-left_m:.3f} m over its fence"))
    return Decision(robot.id, tuple(r for r, _ in found), "; ".join(told for _, told in found))


def _area_m2(corners: Array) -> float:
    x, y = corners.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _is_inside(starts: Array, ends: Array, place: Array) -> bool:
    """Say whether a place is inside: a ray to the right crosses the polygon an odd time."""
    (x1, y1), (x2, y2) = starts.T, ends.T
    spans = (y1 > place[1]) != (y2 > place[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing_x = x1 + (place[1] - y1) * (x2 - x1) / (y2 - y1)
    return bool((spans & (place[0] < crossing_x)).sum() % 2)
