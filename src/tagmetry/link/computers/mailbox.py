"""What has come from the net and was not read yet: bounded, and the oldest is dropped first."""

import threading
from collections import deque

_KEPT = 10_000


class Mailbox:
    """Packets with their topics, from threads of the net to one reader."""

    def __init__(self, kept: int = _KEPT) -> None:
        """Begin empty; at most so many wait."""
        self._waiting: deque[tuple[str, bytes]] = deque(maxlen=kept)
        self._has_come = threading.Event()

    def put(self, topic: str, packet: bytes) -> None:
        """Put one in; never waits."""
        self._waiting.append((topic, packet))
        self._has_come.set()

    def wait(self, timeout_s: float) -> bool:
        """Wait until one is there, at most so long; say whether one is."""
        if not self._waiting:
            self._has_come.wait(timeout_s)
        self._has_come.clear()
        return bool(self._waiting)

    def take(self) -> tuple[str, bytes] | None:
        """Return the oldest; None where none is there."""
        try:
            return self._waiting.popleft()
        except IndexError:
            return None
