"""A robot's link in Python: one socket, no thread; the robot's own loop drives it."""

import secrets
import select
import socket
import time
from collections.abc import Callable

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.link.client.endpoint import Endpoint
from tagmetry.link.client.robot import Robot
from tagmetry.link.sockets import LOOPBACK
from tagmetry.link.wire import KEY_BYTES, PORT


def _now_us() -> int:
    return time.monotonic_ns() // 1000


class RobotClient(Endpoint, Closing):
    """Links a robot with its host; to be used in a with-block.

    Call `step` at least every few hundredths of a second, and drive as `command` says after it.
    """

    def __init__(
        self,
        robot_id: int,
        key: bytes,
        host: str = LOOPBACK,
        port: int = PORT,
        *,
        clock: Callable[[], int] = _now_us,
    ) -> None:
        """Open the socket.

        Args:
            robot_id: Which robot this is.
            key: Its own, as `parse_key` returns it.
            host: The host's address.
            port: The host's port.
            clock: Microseconds that only rise; a simulation has its own.

        Raises:
            InputError: The key has another length, or there is no way to the host.
        """
        if len(key) != KEY_BYTES:
            raise InputError(f"expected a key of {KEY_BYTES} bytes, got {len(key)}; see parse_key")
        super().__init__(Robot(robot_id, key, lambda: secrets.randbits(64)), clock)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect((host, port))
        except (OSError, OverflowError) as error:
            self._socket.close()
            raise InputError(f"no way to the host {host!r}, port {port}: {error}") from error
        self._socket.setblocking(False)

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()

    def _wait(self, timeout_s: float) -> None:
        select.select([self._socket], [], [], timeout_s)

    def _read(self) -> bytes | None:
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
