"""A robot's end of the link in simulated time: its packets lie in lists, not in a socket."""

from collections import deque
from collections.abc import Callable

from tagmetry.link.client.endpoint import Endpoint
from tagmetry.link.client.robot import Robot


class AirClient(Endpoint):
    """The link of one simulated robot of this process."""

    def __init__(
        self, robot_id: int, key: bytes, draw_nonce: Callable[[], int], clock: Callable[[], int]
    ) -> None:
        super().__init__(Robot(robot_id, key, draw_nonce), clock)
        self._arrived: deque[bytes] = deque()
        self._sent: list[bytes] = []

    def bring(self, packet: bytes) -> None:
        """Let a packet arrive; `step` takes it."""
        self._arrived.append(packet)

    def take_sent(self) -> list[bytes]:
        """Return what was sent since the last call."""
        sent, self._sent = self._sent, []
        return sent

    def _wait(self, timeout_s: float) -> None:
        """Wait for nothing: simulated time stands still meanwhile."""

    def _read(self) -> bytes | None:
        return self._arrived.popleft() if self._arrived else None

    def _write(self, packet: bytes | None) -> bool:
        if packet is not None:
            self._sent.append(packet)
        return packet is not None
