"""A scenario made ready for people: every robot can be sent somewhere, and the camera watched."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from tagmetry.arena import Roster
from tagmetry.arena.controllers import ShieldRules
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.eye import Look, Painter, WatchedEye
from tagmetry.live.steered import Steered
from tagmetry.pipeline.arena_twin import CornerEye, Scenario, TwinArena, TwinRobot
from tagmetry.pipeline.arena_twin.ready import ready_scenario
from tagmetry.pipeline.arena_twin.ready.stage import FLOOR_HALF_M


@dataclass(frozen=True, eq=False)
class Performance:
    """A scenario that runs before people.

    Attributes:
        name: Of the scenario.
        arena: The robots.
        steered: Every robot's controller, by id.
        roster: The robots as the arena knows them.
        eye: Whose newest look is painted.
        painter: Paints it; None where nobody wants pictures.
    """

    name: str
    arena: TwinArena
    steered: Mapping[int, Steered]
    roster: Roster
    eye: WatchedEye
    painter: Painter | None

    def send(self, robot_id: int, goal_m: tuple[float, float] | None) -> None:
        """Send a robot to a place on the floor, or give it back to its controller when None.

        Raises:
            InputError: There is no such robot, or the place is not on the floor.
        """
        if robot_id not in self.steered:
            raise InputError(f"there is no robot {robot_id}; there are {list(self.steered)}")
        if goal_m is not None and not _is_on_floor(goal_m):
            raise InputError(f"expected a place on the floor, within {FLOOR_HALF_M}, got {goal_m}")
        self.steered[robot_id].goal_m = goal_m

    def close(self) -> None:
        """End its threads."""
        if self.painter is not None:
            self.painter.close()
        self.arena.close()


def performance(
    name: str, robots: int, give: Callable[[Look, AnyPixels], None] | None
) -> Performance:
    """Return a ready-made scenario that can begin.

    Args:
        name: Of the scenario.
        robots: How many.
        give: Takes the camera's pictures, in a thread of its own; None for no pictures.
    """
    scenario, steered = steerable(ready_scenario(name, robots))
    roster = Roster(tuple(one.robot for one in scenario.robots))
    noise = np.random.default_rng(scenario.seed)
    eye = WatchedEye(CornerEye(roster.robots, scenario.view, noise))
    arena = TwinArena(scenario, eye)
    painter = Painter(roster.robots, eye, give) if give is not None else None
    return Performance(name, arena, steered, roster, eye, painter)


def steerable(scenario: Scenario) -> tuple[Scenario, Mapping[int, Steered]]:
    """Return a scenario whose robots a person can send somewhere, and their controllers by id."""
    rules = ShieldRules(delay_s=scenario.delay_s)
    steered = {
        one.robot.id: Steered(one.controller() if one.controller is not None else None, rules)
        for one in scenario.robots
    }
    robots = tuple(_driven(one, steered[one.robot.id]) for one in scenario.robots)
    return replace(scenario, robots=robots), steered


def _driven(twin: TwinRobot, steered: Steered) -> TwinRobot:
    return replace(twin, controller=lambda: steered)


def _is_on_floor(goal_m: tuple[float, float]) -> bool:
    pairs = zip(goal_m, FLOOR_HALF_M, strict=True)
    return all(isfinite(at_m) and abs(at_m) <= half_m for at_m, half_m in pairs)
