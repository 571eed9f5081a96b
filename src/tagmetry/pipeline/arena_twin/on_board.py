"""What runs on a simulated robot: its end of the link, its odometry, and perhaps its controller.

It is the link's own robot (`link.client.Robot`), fed with simulated time: what stops a real robot
stops this one.
"""

from collections.abc import Iterator
from math import pi

import numpy as np
from numpy.typing import NDArray

from tagmetry.arena.controllers import Controller, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.neighbours import Neighbour
from tagmetry.arena.place import Place
from tagmetry.link import Odometry, Telemetry
from tagmetry.link.client.robot import Robot as LinkedRobot
from tagmetry.pipeline.arena.messages import microseconds
from tagmetry.pipeline.arena_twin.scenario import TwinRobot

_ODOMETRY_S = 0.02
_TELEMETRY_S = 0.5
_FULL_V, _EMPTY_V_PER_S = 8.2, 2e-4  # a battery that lasts for some hours


class OnBoard:
    """The computer of one simulated robot."""

    def __init__(self, twin: TwinRobot, key: bytes, rng: np.random.Generator) -> None:
        self._twin = twin
        self._link = LinkedRobot(twin.robot.id, key, lambda: int(rng.integers(1, 2**63)))
        self._controller: Controller | None = None
        if twin.on_board and twin.controller is not None:
            self._controller = twin.controller()
        self._place = Place(0.0, 0.0, 0.0)
        self._twist = STILL
        self._counts: NDArray[np.int64] | None = None
        self._told_s = self._read_s = float("-inf")
        self.wish = STILL

    @property
    def is_stopped(self) -> bool:
        """Whether its emergency stop is latched."""
        return self._link.is_stopped

    def hear(self, packet: bytes, now_s: float) -> None:
        """Take a packet that has arrived."""
        self._link.receive(packet, microseconds(now_s))

    def step(self, counts: NDArray[np.int64], now_s: float) -> Iterator[bytes]:
        """Read the encoders, decide how to move, and yield the packets to send.

        Args:
            counts: Of the left and the right wheel's encoder, shape (2,).
            now_s: In the robot's own clock.
        """
        due = self._link.due(microseconds(now_s))
        if due is not None:
            yield due
        if now_s - self._read_s >= _ODOMETRY_S - 1e-9:
            self._read(counts, now_s)
            yield from self._report(now_s)
        self.wish = self._wish(now_s)

    def _wish(self, now_s: float) -> Twist:
        now_us = microseconds(now_s)
        if self._controller is not None:
            return self._controller(self._view(now_s)) if self._link.may_move(now_us) else STILL
        command = self._link.command(now_us)
        return Twist(command.forward_mps, command.turn_radps)

    def _view(self, now_s: float) -> View:
        """Return what its packets tell.

        The link's own host time is never early, for safety; half of the round trip less is even.
        """
        told = self._link.neighbours
        even_us = self._link.host_us(microseconds(now_s)) - self._link.round_trip_us / 2
        robot_id, time_s = self._twin.robot.id, even_us / 1e6
        if told is None:
            return View(robot_id, time_s, self._twist)
        neighbours = tuple(
            Neighbour(one.id, one.range_m, one.bearing_rad, one.heading_rad, one.age_s)
            for one in told.seen
        )
        return View(robot_id, time_s, self._twist, neighbours, sensed_s=told.captured_us / 1e6)

    def _read(self, counts: NDArray[np.int64], now_s: float) -> None:
        """Drive on by what the encoders counted since the last reading."""
        if self._counts is not None:
            design = self._twin.design
            turns = (counts - self._counts) * (2 * pi / design.encoder_steps)
            step_s = now_s - self._read_s
            self._twist = design.drive.twist(*(turns / step_s).tolist())
            self._place = self._place.moved(
                self._twist.speed_mps * step_s, self._twist.turn_rate_radps * step_s
            )
        self._counts, self._read_s = counts, now_s

    def _report(self, now_s: float) -> Iterator[bytes]:
        if not self._link.is_linked():
            return
        at_us = self._link.host_us(microseconds(now_s))
        place, twist = self._place, self._twist
        odometry = Odometry(
            at_us, place.x_m, place.y_m, place.heading_rad, twist.speed_mps, 0.0,
            twist.turn_rate_radps,
        )  # fmt: skip
        packets = [self._link.seal(odometry, microseconds(now_s))]
        if now_s - self._told_s >= _TELEMETRY_S:
            self._told_s = now_s
            battery_v = _FULL_V - _EMPTY_V_PER_S * now_s
            packets.append(
                self._link.seal(Telemetry(at_us, (("battery_v", battery_v),)), microseconds(now_s))
            )
        yield from (packet for packet in packets if packet is not None)
