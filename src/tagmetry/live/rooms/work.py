"""What a room does beside the server: in a thread of its own, until it is done or told to end."""

import threading
from abc import ABC, abstractmethod


class Work(ABC):
    """Begins as soon as it is made."""

    def __init__(self, name: str) -> None:
        """Begin; everything that the work needs is there by then.

        Args:
            name: Of the thread.
        """
        self._is_ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    @property
    def is_running(self) -> bool:
        """Whether it goes on."""
        return self._thread.is_alive()

    def end(self) -> None:
        """End after the image that is being worked at."""
        self._is_ending.set()

    def close(self, patience_s: float = 5.0) -> None:
        """End, and wait a little for it."""
        self.end()
        self._thread.join(patience_s)

    @abstractmethod
    def _run(self) -> None:
        """Do it; look at `_is_ending` between images."""
