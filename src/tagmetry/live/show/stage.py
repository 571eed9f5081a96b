"""A scenario made ready for people: every robot can be sent somewhere, and the camera watched."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from tagmetry.arena import Roster
from tagmetry.arena.controllers import ShieldRules
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.show.eye import Look, WatchedEye
from tagmetry.live.show.painter import Painter
from tagmetry.live.show.seeing import EyeKind, seeing
from tagmetry.live.show.steered import Steered
from tagmetry.pipeline.arena_twin import Scenario, TwinArena, TwinRobot


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

    def close(self) -> None:
        """End its threads."""
        if self.painter is not None:
            self.painter.close()
        self.arena.close()


def performance(
    name: str,
    chosen: Scenario,
    give: Callable[[Look, AnyPixels], None] | None,
    eye: EyeKind = "corners",
) -> Performance:
    """Return a scenario that can begin before people.

    Args:
        name: Of the scenario.
        chosen: What runs.
        give: Takes the camera's pictures, in a thread of its own; None for no pictures.
        eye: What is measured.
    """
    scenario, steered = steerable(chosen)
    seen = seeing(eye, scenario)
    arena = TwinArena(replace(scenario, image_rate_hz=seen.image_rate_hz), seen.eye)
    painter = Painter(seen.eye, seen.prepare, give) if give is not None else None
    roster = Roster(tuple(one.robot for one in scenario.robots))
    return Performance(name, arena, steered, roster, seen.eye, painter)


def steerable(scenario: Scenario) -> tuple[Scenario, Mapping[int, Steered]]:
    """Return a scenario whose robots a person can send somewhere, and their controllers by id."""
    rules = ShieldRules(delay_s=scenario.delay_s)
    steered: dict[int, Steered] = {}

    def is_sent(robot: int) -> bool:
        return robot in steered and steered[robot].errand is not None

    for one in scenario.robots:
        own = one.controller() if one.controller is not None else None
        steered[one.robot.id] = Steered(own, rules, is_sent)
    robots = tuple(_driven(one, steered[one.robot.id]) for one in scenario.robots)
    return replace(scenario, robots=robots), steered


def _driven(twin: TwinRobot, steered: Steered) -> TwinRobot:
    return replace(twin, controller=lambda: steered)
