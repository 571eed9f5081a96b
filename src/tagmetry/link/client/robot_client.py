"""A robot's link in Python: one socket, no thread; the robot's own loop drives it."""

import secrets
import select
import socket
import time
from types import TracebackType
from typing import Self

from tagmetry.errors import InputError
from tagmetry.link.client.robot import Robot
from tagmetry.link.messages import Command, Message, Neighbours, Pose
from tagmetry.link.packet import Refusal
from tagmetry.link.sockets import LOOPBACK
from tagmetry.link.wire import KEY_BYTES, PORT


class RobotClient:
    """Links a robot with its host; to be used in a with-block.

    Call `step` at least every few hundredths of a second, and drive as `command` says after it.
    """

    def __init__(self, robot_id: int, key: bytes, host: str = LOOPBACK, port: int = PORT) -> None:
        """Open the socket.

        Raises:
            InputError: The key has another length, or there is no way to the host.
        """
        if len(key) != KEY_BYTES:
            raise InputError(f"expected a key of {KEY_BYTES} bytes, got {len(key)}; see parse_key")
        self._robot = Robot(robot_id, key, lambda: secrets.randbits(64))
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect((host, port))
        except (OSError, OverflowError) as error:
            self._socket.close()
            raise InputError(f"no way to the host {host!r}, port {port}: {error}") from error
        self._socket.setblocking(False)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the socket."""
        self._socket.close()

    @property
    def is_linked(self) -> bool:
        """Whether there is a session."""
        return self._robot.is_linked()

    @property
    def is_stopped(self) -> bool:
        """Whether the emergency stop is latched."""
        return self._robot.is_stopped

    @property
    def may_move(self) -> bool:
        """Whether the host is alive, holds this robot not, and no emergency stop is latched."""
        return self._robot.may_move(_now_us())

    @property
    def command(self) -> Command:
        """How to move now; to stand still where nothing else is granted."""
        return self._robot.command(_now_us())

    @property
    def pose(self) -> Pose | None:
        """Where the host saw it last; None before."""
        return self._robot.pose

    @property
    def neighbours(self) -> Neighbours | None:
        """Whom it would see; None before."""
        return self._robot.neighbours

    @property
    def host_us(self) -> int:
        """The host's time now, for what is measured now."""
        return self._robot.host_us(_now_us())

    def step(self, timeout_s: float = 0.02) -> list[Message]:
        """Wait for packets, at most so long, take all, and send what is due.

        Returns:
            What was accepted, oldest first.
        """
        self._write(self._robot.due(_now_us()))
        select.select([self._socket], [], [], timeout_s)
        taken: list[Message] = []
        while (packet := self._read()) is not None:
            message = self._robot.receive(packet, _now_us())
            if not isinstance(message, Refusal):
                taken.append(message)
        return taken

    def send(self, message: Message) -> bool:
        """Send to the host; False while not linked.

        Raises:
            InputError: The message holds what cannot be sent.
        """
        return self._write(self._robot.seal(message, _now_us()))

    def _read(self) -> bytes | None:
        """Return a packet, None where there is none."""
        try:
            return self._socket.recv(2048)
        except OSError:  # none is there, or nobody listens at the host's port just now
            return None

    def _write(self, packet: bytes | None) -> bool:
        if packet is None:
            return False
        try:
            self._socket.send(packet)
        except OSError:  # the host is not there just now: as if lost in the air
            return False
        return True


def _now_us() -> int:
    return time.monotonic_ns() // 1000
