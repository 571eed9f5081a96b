"""Every robot's computer in a process of its own, which speaks the link over UDP.

Simulated time waits for all of them in every tick (lock-step): so a run is the same however busy
the computer is, and the same as with computers in this process. The packets go through sockets of
this computer, which lose none; what the radio loses and delays is up to the simulated air.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from tagmetry.link.carrier import Address
from tagmetry.link.packet import Header, read_header
from tagmetry.link.sockets import LOOPBACK, open_socket
from tagmetry.pipeline.arena_twin.crew import Acts
from tagmetry.pipeline.arena_twin.motor_bus import MotorBus
from tagmetry.pipeline.arena_twin.programs import program_of
from tagmetry.pipeline.arena_twin.scenario import TwinRobot


class Processes:
    """All robots' computers, side by side."""

    def __init__(
        self, robots: Sequence[TwinRobot], keys: Mapping[int, bytes], patience_s: float = 5.0
    ) -> None:
        """Start them.

        Args:
            robots: All there are.
            keys: Of their links, by id.
            patience_s: How long a robot's process may take for a tick before it is given up.

        Raises:
            InputError: A program cannot be started, or a controller on board is in no file.
        """
        programs = {one.robot.id: program_of(one) for one in robots}
        self._socket = open_socket(LOOPBACK, 0)
        self._addresses: dict[int, Address] = {}
        self._buses: dict[int, MotorBus] = {}
        port = str(self._socket.getsockname()[1])
        try:
            for robot_id, program in programs.items():
                words = (LOOPBACK, port, str(robot_id), keys[robot_id].hex())
                self._buses[robot_id] = MotorBus((*program, *words), patience_s)
        except BaseException:
            self.close()
            raise

    @property
    def faults(self) -> Mapping[int, str]:
        """What is wrong with robots and their processes, by id."""
        return {key: bus.fault for key, bus in self._buses.items() if bus.fault is not None}

    @property
    def process_ids(self) -> Mapping[int, int]:
        """Of the robots' processes, by robot's id."""
        return {key: bus.process_id for key, bus in self._buses.items()}

    def bring(self, robot_id: int, packet: bytes) -> None:
        """Send a packet to a robot that has been heard; it is there when its next tick comes."""
        address = self._addresses.get(robot_id)
        if address is None:
            return
        try:
            self._socket.sendto(packet, address)
        except OSError:  # its process is over
            del self._addresses[robot_id]

    def act(self, counts: NDArray[np.int64], now_us: int) -> Acts:
        """Let all robots' computers do one tick's work, and wait for them."""
        buses = list(self._buses.values())
        for bus, counted in zip(buses, counts.tolist(), strict=True):
            bus.tick(now_us, counted)
        wheels = np.array([bus.answer() for bus in buses])
        return Acts(self._heard(), wheels)

    def close(self) -> None:
        """End all processes, side by side."""
        for bus in self._buses.values():
            bus.hang_up()
        for bus in self._buses.values():
            bus.close()
        self._socket.close()

    def _heard(self) -> tuple[bytes, ...]:
        """Return the packets that have arrived, in the robots' order, whoever was quicker."""
        by_robot: dict[int, list[bytes]] = {robot_id: [] for robot_id in self._buses}
        while (arrived := self._next()) is not None:
            packet, address = arrived
            header = read_header(packet, "robot")
            if isinstance(header, Header) and header.robot in by_robot:
                self._addresses[header.robot] = address
                by_robot[header.robot].append(packet)
        return tuple(packet for packets in by_robot.values() for packet in packets)

    def _next(self) -> tuple[bytes, Address] | None:
        try:
            return self._socket.recvfrom(2048)
        except OSError:  # nothing more has arrived
            return None
