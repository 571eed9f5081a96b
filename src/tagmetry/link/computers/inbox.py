"""What has come from the net and was not read yet: bounded, and the oldest is dropped first.

The net fills it without Python: a callback for every packet would wait its turn behind a busy
program each time, some milliseconds, and packets would come faster than they are heard.
"""

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from tagmetry.link.wire import MOST_BYTES

if TYPE_CHECKING:
    from zenoh import Subscriber

_LOOK_S = 0.001
Packet = tuple[str, bytes]  # with its topic first


class Inbox:
    """Packets with their topics, for one reader."""

    def __init__(self, ring: "Subscriber", closed: type[Exception]) -> None:
        """Read from a ring that the net fills; it raises `closed` after its end."""
        self._ring, self._closed = ring, closed
        self._next: Packet | None = None

    def wait(self, timeout_s: float) -> bool:
        """Wait until a packet is there, at most so long; say whether one is."""
        end_s = time.monotonic() + timeout_s
        while self._next is None:
            self._next = self._read()
            rest_s = end_s - time.monotonic()
            if self._next is not None or rest_s <= 0:
                break
            time.sleep(min(_LOOK_S, rest_s))
        return self._next is not None

    def take(self) -> Packet | None:
        """Return the oldest packet; None where none is there."""
        found, self._next = self._next, None
        return found if found is not None else self._read()

    def all(self, most: int) -> Iterator[Packet]:
        """Give the packets that are there, the oldest first, not more than so many."""
        for _ in range(most):
            found = self.take()
            if found is None:
                return
            yield found

    def _read(self) -> Packet | None:
        """Return the next packet; what is longer than any is passed over."""
        try:
            while (sample := self._ring.try_recv()) is not None:
                if len(sample.payload) <= MOST_BYTES:
                    return str(sample.key_expr), bytes(sample.payload)
        except self._closed:
            return None
        return None
