"""What waits to be told to the server's program: one place a kind, and the newest wins."""

import threading

from tagmetry.live.beside.parcels import Parcel


class Outbox:
    """Filled by several threads, emptied by one."""

    def __init__(self) -> None:
        self._waiting: dict[str, Parcel] = {}
        self._changed = threading.Condition()
        self._is_closed = False

    def put(self, place: str, parcel: Parcel) -> None:
        """Replace what waits at a place; returns at once."""
        with self._changed:
            self._waiting[place] = parcel
            self._changed.notify()

    def close(self) -> None:
        """Let `take` return None from now on."""
        with self._changed:
            self._is_closed = True
            self._changed.notify()

    def take(self) -> Parcel | None:
        """Wait for what comes, the oldest place first; None when it is closed."""
        with self._changed:
            while not self._waiting and not self._is_closed:
                self._changed.wait()
            if self._is_closed:
                return None
            return self._waiting.pop(next(iter(self._waiting)))
