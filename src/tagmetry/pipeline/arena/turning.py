"""One turn of an arena's host: from an image's markers to what every robot is told.

markers -> arena (tracks) -> neighbours, as they stood in the image
                          -> each robot carried on to when a command acts -> its controller
        -> safety: who has to stop stands still, whatever its controller wants
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from tagmetry.arena import (
    Arena,
    ArenaStep,
    Decision,
    Neighbourhood,
    SafetyRules,
    StopForAll,
    Told,
    WorldState,
    decide,
)
from tagmetry.arena.drive import Twist
from tagmetry.detect import Detection
from tagmetry.pipeline.arena.drivers import Drivers
from tagmetry.pipeline.arena.stage_times import NOT_TIMED, StageTimes


@dataclass(frozen=True, eq=False)
class Turn:
    """What one image led to.

    Attributes:
        step: What the image told.
        world: All robots when the commands act.
        told: What each robot may know, where there is a sensor, as of the image.
        decisions: Whether each robot may drive.
        stop: The stop for all.
        commands: How every robot shall move that has a controller, by id.
        times: How long each step took; `detect_s` is not known here.
    """

    step: ArenaStep
    world: WorldState
    told: tuple[Told, ...]
    decisions: tuple[Decision, ...]
    stop: StopForAll
    commands: Mapping[int, Twist]
    times: StageTimes = NOT_TIMED


@dataclass
class Turning:
    """Follows robots, says what each may know, and drives those that have controllers.

    Attributes:
        arena: Follows the robots.
        neighbourhood: Says what each robot may know; nothing where None.
        safety: When robots are stopped.
        drivers: The controllers.
    """

    arena: Arena
    neighbourhood: Neighbourhood | None = None
    safety: SafetyRules = field(default_factory=SafetyRules)
    drivers: Drivers = field(default_factory=lambda: Drivers({}))

    def __post_init__(self) -> None:
        self.stop = StopForAll()

    def turn(
        self, detections: Sequence[Detection], image_s: float, acts_s: Callable[[], float]
    ) -> Turn:
        """Return what an image leads to.

        Args:
            detections: All markers of the image.
            image_s: When it was taken.
            acts_s: Says, once the tracks are up to date, when a command that is sent now acts; the
                image's clock, not before the image.
        """
        began_s = time.monotonic()
        step = self.arena.take(detections, image_s)
        world = self.arena.world_at(acts_s())
        followed_s = time.monotonic()
        told = self.neighbourhood.tell(step.world) if self.neighbourhood is not None else ()
        told_s = time.monotonic()
        if step.is_bumped and step.bump is not None:
            self.stop = self.stop.pressed(step.bump.told, image_s)
        decided = decide(world, self.arena.roster.robots, self.safety, self.stop)
        decisions = self.drivers.judged(decided, step.world)
        commands = self.drivers.commands(told, world, decisions, self._sensed_s(told))
        times = StageTimes(
            0.0, followed_s - began_s, told_s - followed_s, time.monotonic() - told_s
        )
        return Turn(step, world, told, decisions, self.stop, commands, times)

    def _sensed_s(self, told: Sequence[Told]) -> Mapping[int, float]:
        """Return the moments that robots are told of: their sensors' delays ago."""
        if self.neighbourhood is None:
            return {}
        sensor_of = self.neighbourhood.sensor_of
        return {one.robot_id: one.time_s - sensor_of(one.robot_id).delay_s for one in told}
