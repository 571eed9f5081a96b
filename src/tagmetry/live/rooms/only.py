"""A room does one thing at a time, however many operators ask."""

from collections.abc import Callable
from typing import Generic, TypeVar

from tagmetry.errors import InputError
from tagmetry.live.rooms.work import Work

W = TypeVar("W", bound=Work)


class OnlyWork(Generic[W]):
    """The one piece of work of a room.

    Attributes:
        newest: What runs, or ran last; None before the first.
    """

    def __init__(self, *, runs: str, rests: str) -> None:
        """Begin with none.

        Args:
            runs: Why no other can begin now, for people.
            rests: Why there is nothing to end, for people.
        """
        self.newest: W | None = None
        self._runs, self._rests = runs, rests

    def begin(self, make: Callable[[], W]) -> None:
        """Begin another one.

        Raises:
            InputError: One runs.
        """
        if self.newest is not None and self.newest.is_running:
            raise InputError(self._runs)
        self.newest = make()

    def end(self) -> None:
        """Tell it to end.

        Raises:
            InputError: None runs.
        """
        if self.newest is None or not self.newest.is_running:
            raise InputError(self._rests)
        self.newest.end()

    def close(self) -> None:
        """End what runs, and wait a little for it."""
        if self.newest is not None:
            self.newest.close()
