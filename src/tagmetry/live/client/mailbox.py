"""What came from the server: of every kind the newest, for whoever waits for it."""

import threading
import time
from typing import TypeVar

from tagmetry.errors import InputError
from tagmetry.live.messages import Told

_Kind = TypeVar("_Kind", bound=Told)


class Mailbox:
    """Filled by one thread and read by others."""

    def __init__(self) -> None:
        self._newest: dict[type, tuple[int, Told]] = {}
        self._changed = threading.Condition()
        self._why: str | None = None

    def put(self, message: Told) -> None:
        """Replace what is there of this kind."""
        with self._changed:
            self._newest[type(message)] = self._count(type(message)) + 1, message
            self._changed.notify_all()

    def end(self, why: str) -> None:
        """Say that nothing more comes, and why."""
        with self._changed:
            self._why = why
            self._changed.notify_all()

    def newest(self, kind: type[_Kind]) -> _Kind | None:
        """Return what came last; None before the first."""
        with self._changed:
            message = self._newest[kind][1] if kind in self._newest else None
        return message if isinstance(message, kind) else None

    def count(self, kind: type[Told]) -> int:
        """Return how many of a kind came."""
        with self._changed:
            return self._count(kind)

    def after(self, kind: type[_Kind], count: int, seconds: float) -> tuple[int, _Kind] | None:
        """Wait for more than so many of a kind; return how many came and the newest.

        Args:
            kind: Of message.
            count: How many are known already.
            seconds: To wait at most; None is returned when they are over.

        Raises:
            InputError: Nothing more comes.
        """
        end_s = time.monotonic() + seconds
        with self._changed:
            while self._count(kind) <= count:
                if self._why is not None:
                    raise InputError(self._why)
                if not self._changed.wait(end_s - time.monotonic()):
                    return None
            number, message = self._newest[kind]
        return (number, message) if isinstance(message, kind) else None

    def _count(self, kind: type) -> int:
        return self._newest[kind][0] if kind in self._newest else 0
