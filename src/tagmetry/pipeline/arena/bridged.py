"""What other computers are told of an arena's results, and how what they command comes in."""

from collections.abc import Callable, Mapping

from tagmetry.arena.controllers import Controller, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.link import Command
from tagmetry.link.computers import ArenaBridge, state_message
from tagmetry.link.computers.sight import STOPPED
from tagmetry.link.messages import ArenaState
from tagmetry.pipeline.arena.measurement import ArenaMeasurement, ArenaResult, image_time_s
from tagmetry.pipeline.arena.messages import command_message, microseconds, neighbours_messages

_HELD = Command(valid_for_ms=0)
_COUNTS = 2**32


class BridgeTaker:
    """Tells other computers all of every image; behind `Posted`, since nobody waits for them."""

    def __init__(
        self, bridge: ArenaBridge, range_m: float, ranges_m: Mapping[int, float] | None = None
    ) -> None:
        """Tell nothing yet.

        Args:
            bridge: The bridge, which is open; whoever opened it closes it.
            range_m: Reach of the sensor for neighbours, told with them.
            ranges_m: Of some robots, by id, another one.
        """
        self._bridge = bridge
        self._range_m, self._ranges_m = range_m, dict(ranges_m or {})

    def take(self, result: ArenaResult) -> None:
        """Tell what one image tells."""
        moment_us = microseconds(result.taken_s + result.world.time_s - image_time_s(result.image))
        self._tell_commands(result)
        ranges_m = [self._ranges_m.get(one.robot_id, self._range_m) for one in result.told]
        sensed = neighbours_messages(result.told, ranges_m, result.taken_s)
        for told, message in zip(result.told, sensed, strict=True):
            self._bridge.tell(told.robot_id, message)
        held = {one.robot_id for one in result.decisions if one.must_stop}
        for state in result.world:
            told_state = state_message(state, moment_us, must_stand=state.id in held)
            self._bridge.tell(state.id, told_state)
        self._bridge.tell_image(_arena_state(result, moment_us))

    def close(self) -> None:
        """Nothing comes last; the bridge falls silent by itself."""

    def _tell_commands(self, result: ArenaResult) -> None:
        held = {one.robot_id: _HELD for one in result.decisions if one.must_stop}
        driven = {key: command_message(twist) for key, twist in result.commands.items()}
        for robot_id, command in (driven | held).items():
            self._bridge.tell(robot_id, command)


class RemoteStop:
    """Presses the stop for all while another computer's emergency stop is latched."""

    def __init__(self, bridge: ArenaBridge, measurement: ArenaMeasurement) -> None:
        """Watch; it takes effect from the next image on."""
        self._bridge, self._measurement = bridge, measurement
        self._is_pressed = False

    def take(self, result: ArenaResult) -> None:
        """Press, or release what was pressed."""
        was_pressed, self._is_pressed = self._is_pressed, self._bridge.is_stopped
        if self._is_pressed:
            self._measurement.press_stop("another computer stops all", result.world.time_s)
        elif was_pressed:
            self._measurement.release_stop()

    def close(self) -> None:
        """Nothing comes last."""


def commanded_controllers(
    bridge: ArenaBridge, otherwise: Callable[[int], Controller] | None
) -> Callable[[int], Controller]:
    """Return what makes every robot's controller: another computer's commands come first.

    Args:
        bridge: Where they come in.
        otherwise: Makes the controllers of robots that no computer commands; none when None.
    """

    def make(robot_id: int) -> Controller:
        own = otherwise(robot_id) if otherwise is not None else _still

        def control(view: View) -> Twist:
            command = bridge.command(robot_id)
            return own(view) if command is None else Twist(command.forward_mps, command.turn_radps)

        return control

    return make


def _still(_view: View) -> Twist:
    return STILL


def _arena_state(result: ArenaResult, moment_us: int) -> ArenaState:
    robots = result.world.robots
    return ArenaState(
        moment_us,
        result.image.sequence % _COUNTS,
        STOPPED * result.stop.is_pressed,
        len(robots),
        sum(one.seen for one in robots),
    )
