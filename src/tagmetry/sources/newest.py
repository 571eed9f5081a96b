"""A place for one image between two threads: who puts never waits, who takes gets the newest."""

import threading
from typing import Generic, TypeVar

T = TypeVar("T")

_WAKE_S = 0.5  # so that an interrupt from the keyboard gets through on every system


class Newest(Generic[T]):
    """Holds the newest value that nobody has taken yet."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._value: T | None = None
        self._error: Exception | None = None
        self._is_closed = False

    def put(self, value: T) -> None:
        """Replace what nobody took."""
        with self._changed:
            self._value = value
            self._changed.notify()

    def take(self) -> T | None:
        """Wait for a value and remove it; None once the place is closed.

        Raises:
            Exception: The one that the place was closed with.
        """
        with self._changed:
            while self._value is None and not self._is_closed:
                self._changed.wait(_WAKE_S)
            if self._error is not None:
                raise self._error
            value, self._value = self._value, None
            return None if self._is_closed else value

    def close(self, error: Exception | None = None) -> None:
        """Wake everybody who waits, with an error where there is one; the first call counts."""
        with self._changed:
            if not self._is_closed:
                self._is_closed, self._error = True, error
            self._changed.notify_all()
