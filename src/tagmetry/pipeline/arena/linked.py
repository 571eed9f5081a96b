"""What robots are told over the link: neighbours, their pose where they may know it, stops."""

from collections.abc import Collection, Mapping

from tagmetry.files.arena import ArenaSetup
from tagmetry.link import Command, Host, Message
from tagmetry.pipeline.arena.measurement import ArenaResult, image_time_s
from tagmetry.pipeline.arena.messages import command_message, neighbours_messages, pose_message

_ToRobot = tuple[int, Message]


def sensor_ranges_m(setup: ArenaSetup) -> tuple[float, dict[int, float]]:
    """Return the reach of the sensors for neighbours: of all robots, and of some, by id."""
    range_m = setup.sensor.range_m if setup.sensor is not None else float("inf")
    return range_m, {number: one.range_m for number, one in setup.sensors.items()}


class LinkTaker:
    """Sends every robot what it may know, from the thread that measured it.

    A robot that must not drive is sent a command to stand still with every result; the stop for all
    is the link's own emergency stop, which latches on the robots too.
    """

    def __init__(
        self,
        host: Host,
        range_m: float,
        ranges_m: Mapping[int, float] | None = None,
        *,
        poses: bool = False,
        every_s: float = 0.02,
        silent: Collection[int] = (),
    ) -> None:
        """Send nothing yet.

        Args:
            host: The link, which is open.
            range_m: Reach of the sensor for neighbours, told with them.
            ranges_m: Of some robots, by id, another one.
            poses: Robots may know where they are in the world.
            every_s: Least time between two messages to a robot; wireless nets stand no more.
            silent: Robots that have no link, such as simulated ones, by id.
        """
        self._host, self._poses, self._every_s = host, poses, every_s
        self._range_m, self._ranges_m = range_m, dict(ranges_m or {})
        self._silent = frozenset(silent)
        self._sent_s = float("-inf")
        self._is_stopped = False

    def take(self, result: ArenaResult) -> None:
        """Send what one image tells."""
        self._stop(result)
        if result.done_s - self._sent_s < self._every_s:
            self._host.pulse()
            return
        self._sent_s = result.done_s
        messages = [*self._commands(result), *self._neighbours(result)]
        if self._poses:
            acts_s = result.taken_s + result.world.time_s - image_time_s(result.image)
            messages += [(state.id, pose_message(state, acts_s)) for state in result.world]
        self._host.send_all([one for one in messages if one[0] not in self._silent])

    def close(self) -> None:
        """The host falls silent by itself, and robots stop."""

    def _commands(self, result: ArenaResult) -> list[_ToRobot]:
        """Return commands, to stand still where a robot must not drive."""
        commands: list[_ToRobot] = [
            (robot_id, command_message(twist)) for robot_id, twist in result.commands.items()
        ]
        halt = Command(valid_for_ms=0)
        return commands + [(one.robot_id, halt) for one in result.decisions if one.must_stop]

    def _neighbours(self, result: ArenaResult) -> list[_ToRobot]:
        """Return whom each robot senses."""
        told = result.told
        ranges_m = [self._ranges_m.get(one.robot_id, self._range_m) for one in told]
        messages = neighbours_messages(told, ranges_m, result.taken_s)
        return [(one.robot_id, message) for one, message in zip(told, messages, strict=True)]

    def _stop(self, result: ArenaResult) -> None:
        if result.stop.is_pressed and not self._is_stopped:
            self._host.stop()
        if self._is_stopped and not result.stop.is_pressed:
            self._host.release()
        self._is_stopped = result.stop.is_pressed
