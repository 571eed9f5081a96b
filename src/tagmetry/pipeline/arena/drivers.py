"""The controllers of robots that are driven from the host, and what each of them knows."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from tagmetry.arena import Decision, RobotState, Told, WorldState
from tagmetry.arena.controllers import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.own_motion import OwnMotion
from tagmetry.arena.place import Place
from tagmetry.arena.safety import StopReason
from tagmetry.pipeline.arena.guarded import Guarded
from tagmetry.pipeline.arena.obedience import Obedience


class Drivers:
    """Asks every robot's controller, unless the robot has to stop."""

    def __init__(
        self, controllers: Mapping[int, Guarded], is_driven: Callable[[int], bool] | None = None
    ) -> None:
        """Take controllers; a robot without one gets no commands.

        Args:
            controllers: By the robot's id.
            is_driven: Says whether a robot's controller drives it just now; always when None.
        """
        self._controllers = controllers
        self._is_driven = is_driven if is_driven is not None else _always
        self._moving = {robot_id: OwnMotion() for robot_id in controllers}
        self._obedience = Obedience()

    def judged(self, decisions: Sequence[Decision], world: WorldState) -> tuple[Decision, ...]:
        """Return decisions in which faults of controllers and robots are reasons to stop.

        Args:
            decisions: Who has to stop anyway.
            world: All robots at the image's time.
        """
        if not self._controllers:
            return tuple(decisions)
        for state in world:
            if state.id in self._controllers and self._is_driven(state.id):
                self._obedience.watch(state, self._moving[state.id].at(state.time_s))
        return tuple(map(self._with_fault, decisions))

    def commands(
        self,
        told: Sequence[Told],
        world: WorldState,
        decisions: Sequence[Decision],
        sensed_s: Mapping[int, float],
    ) -> Mapping[int, Twist]:
        """Return how every robot that has a controller shall move, by id.

        Args:
            told: What each may know, of those that have a sensor.
            world: All robots when a command acts.
            decisions: Who has to stop.
            sensed_s: What moment each is told of, by id.
        """
        if not self._controllers:
            return {}
        stopped = {one.robot_id for one in decisions if one.must_stop}
        known = {one.robot_id: one for one in told}
        commands = dict.fromkeys(filter(self._is_driven, self._controllers), STILL)
        for state in world:
            if state.id in commands and state.id not in stopped:
                own = known.get(state.id, Told.nothing(state.id, world.time_s))
                sensed = sensed_s.get(state.id, world.time_s)
                commands[state.id] = self._asked(state, own, sensed)
        for robot_id, twist in commands.items():
            self._moving[robot_id].command(twist, world.time_s)
        return commands

    def close(self) -> None:
        """End the controllers' threads."""
        for controller in self._controllers.values():
            controller.close()

    def _asked(self, state: RobotState, told: Told, sensed_s: float) -> Twist:
        view = View(
            state.id,
            state.time_s,
            self._moving[state.id].at(state.time_s),
            told.neighbours,
            told.obstacles,
            Place(state.x_m, state.y_m, state.heading_rad),
            sensed_s,
        )
        return self._controllers[state.id](view)

    def _with_fault(self, decision: Decision) -> Decision:
        controller = self._controllers.get(decision.robot_id)
        astray = self._obedience.faults.get(decision.robot_id)
        if controller is not None and controller.fault is not None:
            decision = _stopped(decision, "controller", controller.fault)
        return _stopped(decision, "disobeys", astray) if astray is not None else decision


def _always(_robot_id: int) -> bool:
    return True


def _stopped(decision: Decision, reason: StopReason, fault: str) -> Decision:
    told = "; ".join(part for part in (decision.told, fault) if part)
    return replace(decision, reasons=(*decision.reasons, reason), told=told)
