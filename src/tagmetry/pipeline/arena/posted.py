"""A taker in a thread of its own, behind a bounded queue: it never delays the measurement.

What it cannot keep up with is dropped, the oldest first, and counted. Where nothing may be lost, as
with a video's file, the queue makes the measurement wait instead.
"""

import threading
from collections import deque

from tagmetry.pipeline.arena.measurement import ArenaResult
from tagmetry.pipeline.arena.taker import Taker

_WAKE_S = 0.5  # so that an interrupt from the keyboard gets through on every system


class Posted:
    """Hands results on to a taker, from a thread of its own."""

    def __init__(self, taker: Taker, *, longest: int = 1, may_drop: bool = True) -> None:
        """Start the thread.

        Args:
            taker: Who takes them in the end.
            longest: How many results may wait.
            may_drop: Drop the oldest where more would wait; else `take` waits.
        """
        self._taker, self._longest, self._may_drop = taker, longest, may_drop
        self._changed = threading.Condition()
        self._waiting: deque[ArenaResult] = deque()
        self._error: Exception | None = None
        self._is_closed = False
        self.dropped = 0
        self._thread = threading.Thread(target=self._run, name="taker", daemon=True)
        self._thread.start()

    def take(self, result: ArenaResult) -> None:
        """Put a result into the queue.

        Raises:
            Exception: The one that the taker failed with.
        """
        with self._changed:
            while not self._may_drop and len(self._waiting) >= self._longest and not self._error:
                self._changed.wait(_WAKE_S)
            self._raise()
            if len(self._waiting) >= self._longest:
                self._waiting.popleft()
                self.dropped += 1
            self._waiting.append(result)
            self._changed.notify_all()

    def close(self) -> None:
        """Hand on what waits, then close the taker.

        Raises:
            Exception: The one that the taker failed with.
        """
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._thread.join()
        self._taker.close()
        self._raise()

    def _raise(self) -> None:
        if self._error is not None:
            error, self._error = self._error, None
            raise error

    def _run(self) -> None:
        while (result := self._next()) is not None:
            try:
                self._taker.take(result)
            except Exception as error:  # noqa: BLE001 (raised where it is waited for)
                with self._changed:
                    self._error, self._is_closed = error, True
                    self._waiting.clear()
                    self._changed.notify_all()
                return

    def _next(self) -> ArenaResult | None:
        with self._changed:
            while not self._waiting and not self._is_closed:
                self._changed.wait(_WAKE_S)
            if not self._waiting:
                return None
            result = self._waiting.popleft()
            self._changed.notify_all()
            return result
