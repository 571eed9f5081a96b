"""What runs on a simulated robot: its odometry, its motors, and perhaps its controller.

Its end of the link is that of a real robot (`link.client`), fed with simulated time: what stops a
real robot stops this one.
"""

from math import pi

from tagmetry.arena.controllers import Controller, View
from tagmetry.arena.drive import STILL, Drive, Twist
from tagmetry.arena.place import Place
from tagmetry.arena.told import Neighbour
from tagmetry.link import Odometry, Telemetry
from tagmetry.link.client.endpoint import Endpoint
from tagmetry.pipeline.arena.guarded import Guarded

_ODOMETRY_US = 20_000
_TELEMETRY_US = 500_000
_FULL_V, _EMPTY_V_PER_S = 8.2, 2e-4  # a battery that lasts for some hours

WheelSpeeds = tuple[float, float]


class OnBoard:
    """The computer of one simulated robot."""

    def __init__(
        self,
        robot_id: int,
        drive: Drive,
        encoder_steps: int,
        link: Endpoint,
        controller: Controller | None = None,
    ) -> None:
        """Switch it on.

        Args:
            robot_id: Which robot.
            drive: Its wheels.
            encoder_steps: Of a wheel's full turn.
            link: Its end of the link.
            controller: What steers it; None where the host's commands do.
        """
        self._robot_id, self._drive, self._link = robot_id, drive, link
        self._rad_per_step = 2 * pi / encoder_steps
        self._controller = Guarded(controller) if controller is not None else None
        self._place = Place(0.0, 0.0, 0.0)
        self._twist = STILL
        self._counts: tuple[int, int] | None = None
        self._told_us: int | None = None
        self._read_us = 0

    @property
    def fault(self) -> str | None:
        """Why its own controller was given up; None while it does well."""
        return self._controller.fault if self._controller is not None else None

    def step(self, counts: tuple[int, int], now_us: int) -> WheelSpeeds:
        """Take the packets that have arrived, send what is due, and return how to turn the wheels.

        Args:
            counts: Of the left and the right wheel's encoder.
            now_us: In the robot's own clock, the one of its link.

        Returns:
            The speeds of the left and the right wheel, rad/s.
        """
        self._link.step(0.0)
        if self._counts is None or now_us - self._read_us >= _ODOMETRY_US:
            self._read(counts, now_us)
            self._report(now_us)
        return self._drive.wheel_speeds_radps(self._drive.within(self._wish()))

    def close(self) -> None:
        """End its controller's thread."""
        if self._controller is not None:
            self._controller.close()

    def _wish(self) -> Twist:
        if self._controller is not None:
            return self._controller(self._view()) if self._link.may_move else STILL
        command = self._link.command
        return Twist(command.forward_mps, command.turn_radps)

    def _view(self) -> View:
        """Return what its packets tell.

        The link's own host time is never early, for safety; half of the round trip less is even.
        """
        told = self._link.neighbours
        time_s = (self._link.host_us - self._link.round_trip_us / 2) / 1e6
        if told is None:
            return View(self._robot_id, time_s, self._twist)
        neighbours = tuple(
            Neighbour(one.id, one.range_m, one.bearing_rad, one.heading_rad, one.age_s)
            for one in told.seen
        )
        sensed_s = told.captured_us / 1e6
        return View(self._robot_id, time_s, self._twist, neighbours, sensed_s=sensed_s)

    def _read(self, counts: tuple[int, int], now_us: int) -> None:
        """Drive on by what the encoders counted since the last reading."""
        if self._counts is not None:
            step_s = (now_us - self._read_us) / 1e6
            left, right = (
                (now - before) * self._rad_per_step / step_s
                for now, before in zip(counts, self._counts, strict=True)
            )
            self._twist = self._drive.twist(left, right)
            self._place = self._place.moved(
                self._twist.speed_mps * step_s, self._twist.turn_rate_radps * step_s
            )
        self._counts, self._read_us = counts, now_us

    def _report(self, now_us: int) -> None:
        if not self._link.is_linked:
            return
        at_us, place, twist = self._link.host_us, self._place, self._twist
        self._link.send(
            Odometry(
                at_us, place.x_m, place.y_m, place.heading_rad, twist.speed_mps, 0.0,
                twist.turn_rate_radps,
            )
        )  # fmt: skip
        if self._told_us is None or now_us - self._told_us >= _TELEMETRY_US:
            self._told_us = now_us
            battery_v = _FULL_V - _EMPTY_V_PER_S * now_us / 1e6
            self._link.send(Telemetry(at_us, (("battery_v", battery_v),)))
