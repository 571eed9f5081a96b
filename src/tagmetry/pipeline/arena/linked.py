"""What robots are told over the link: neighbours, their pose where they may know it, stops."""

from collections.abc import Mapping

from tagmetry.arena import Told, WorldState
from tagmetry.link import Command, Host, Neighbour, Neighbours, Pose
from tagmetry.pipeline.arena.measurement import ArenaResult, image_time_s

_US = 1_000_000
_COMMAND_MS = 200


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
    ) -> None:
        """Send nothing yet.

        Args:
            host: The link, which is open.
            range_m: Reach of the sensor for neighbours, told with them.
            ranges_m: Of some robots, by id, another one.
            poses: Robots may know where they are in the world.
            every_s: Least time between two messages to a robot; wireless nets stand no more.
        """
        self._host, self._poses, self._every_s = host, poses, every_s
        self._range_m, self._ranges_m = range_m, dict(ranges_m or {})
        self._sent_s = float("-inf")
        self._is_stopped = False

    def take(self, result: ArenaResult) -> None:
        """Send what one image tells."""
        self._stop(result)
        if result.done_s - self._sent_s < self._every_s:
            self._host.pulse()
            return
        self._sent_s = result.done_s
        self._drive(result)
        for told in result.told:
            self._host.send(told.robot_id, self._neighbours(told, round(result.taken_s * _US)))
        if self._poses:
            ahead_s = result.world.time_s - image_time_s(result.image)
            self._send_poses(result.world, round((result.taken_s + ahead_s) * _US))

    def close(self) -> None:
        """The host falls silent by itself, and robots stop."""

    def _drive(self, result: ArenaResult) -> None:
        """Send commands, to stand still where a robot must not drive."""
        for robot_id, twist in result.commands.items():
            command = Command(twist.speed_mps, 0.0, twist.turn_rate_radps, _COMMAND_MS)
            self._host.send(robot_id, command)
        for one in result.decisions:
            if one.must_stop:
                self._host.send(one.robot_id, Command(valid_for_ms=0))

    def _stop(self, result: ArenaResult) -> None:
        if result.stop.is_pressed and not self._is_stopped:
            self._host.stop()
        if self._is_stopped and not result.stop.is_pressed:
            self._host.release()
        self._is_stopped = result.stop.is_pressed

    def _neighbours(self, told: Told, captured_us: int) -> Neighbours:
        seen = tuple(
            Neighbour(
                near.id, near.range_m, near.bearing_rad, near.relative_heading_rad, near.age_s
            )
            for near in told.neighbours
        )
        range_m = self._ranges_m.get(told.robot_id, self._range_m)
        return Neighbours(captured_us, range_m, seen)

    def _send_poses(self, world: WorldState, captured_us: int) -> None:
        for state in world:
            sd = (state.covariance[[0, 1, 2], [0, 1, 2]].clip(0.0) ** 0.5).tolist()
            pose = Pose(
                captured_us,
                state.x_m,
                state.y_m,
                state.heading_rad,
                state.speed_mps,
                state.turn_rate_radps,
                max(sd[0], sd[1]),
                sd[2],
            )
            self._host.send(state.id, pose)
