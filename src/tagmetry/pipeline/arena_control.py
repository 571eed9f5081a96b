"""One turn of an arena's host: from an image's markers to what every robot is told.

markers -> arena (tracks) -> neighbours, as they stood in the image
                          -> each robot carried on to when a command acts -> its controller
        -> safety: who has to stop stands still, whatever its controller wants
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

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
from tagmetry.arena.controllers import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.own_motion import OwnMotion
from tagmetry.arena.place import Place
from tagmetry.detect import Detection
from tagmetry.pipeline.guarded import Guarded


@dataclass(frozen=True, eq=False)
class Turn:
    """What one image led to.

    Attributes:
        step: What the image told.
        world: All robots when the commands act.
        told: What every robot may know, as of the image.
        decisions: Who has to stop, and why.
        commands: How every robot shall move that has a controller, by id.
    """

    step: ArenaStep
    world: WorldState
    told: tuple[Told, ...]
    decisions: tuple[Decision, ...]
    commands: Mapping[int, Twist]


class ArenaControl:
    """Follows robots and drives them."""

    def __init__(
        self,
        arena: Arena,
        neighbourhood: Neighbourhood,
        rules: SafetyRules,
        controllers: Mapping[int, Guarded],
    ) -> None:
        """Take what an arena consists of.

        Args:
            arena: Follows the robots.
            neighbourhood: Says what each may know.
            rules: What robots are stopped for.
            controllers: By robot's id; a robot without one gets no commands.
        """
        self._arena, self._neighbourhood, self._rules = arena, neighbourhood, rules
        self._controllers = controllers
        self._moving = {robot_id: OwnMotion() for robot_id in controllers}
        self.stop = StopForAll()

    def turn(
        self,
        detections: Sequence[Detection],
        image_s: float,
        acts_s: float,
    ) -> Turn:
        """Return what an image leads to.

        Args:
            detections: All markers of the image.
            image_s: When it was taken.
            acts_s: When a command that is sent now acts; the same clock, not before the image.
        """
        step = self._arena.take(detections, image_s)
        world = self._arena.world_at(acts_s)
        told = self._neighbourhood.tell(step.world)
        decisions = self._decisions(world)
        stopped = {one.robot_id for one in decisions if one.must_stop}
        commands = {
            one.robot_id: STILL if one.robot_id in stopped else self._driven(one, world)
            for one in told
            if one.robot_id in self._controllers
        }
        commands |= {one: STILL for one in stopped if one in self._controllers}
        for robot_id, twist in commands.items():
            self._moving[robot_id].command(twist, acts_s)
        return Turn(step, world, told, decisions, commands)

    def _driven(self, told: Told, world: WorldState) -> Twist:
        state = world.robot(told.robot_id)
        if state is None:
            return STILL
        moving = self._moving[told.robot_id]
        sensed_s = told.time_s - self._neighbourhood.sensor_of(told.robot_id).delay_s
        view = View(
            told.robot_id,
            state.time_s,
            moving.at(state.time_s),
            told.neighbours,
            told.obstacles,
            Place(state.x_m, state.y_m, state.heading_rad),
            sensed_s,
        )
        return self._controllers[told.robot_id](view)

    def _decisions(self, world: WorldState) -> tuple[Decision, ...]:
        robots = self._arena.roster.robots
        decided = decide(world, robots, self._rules, self.stop)
        return tuple(self._with_fault(one) for one in decided)

    def _with_fault(self, decision: Decision) -> Decision:
        controller = self._controllers.get(decision.robot_id)
        if controller is None or controller.fault is None:
            return decision
        told = "; ".join(part for part in (decision.told, controller.fault) if part)
        return replace(decision, reasons=(*decision.reasons, "controller"), told=told)
