"""A thread that reads one connection until it fails or nobody wants it any more.

A read can hang inside a driver, where nothing can end it. The thread is then left behind: it is a
daemon, and what it may still bring is not taken.
"""

import threading
from collections.abc import Callable
from contextlib import closing

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.connection import ConnectionLostError, Opener

Take = Callable[["Reader", AnyPixels, float], None]


class Reader:
    """Opens a connection and hands on each image with the time at which it arrived."""

    def __init__(self, name: str, opener: Opener, take: Take, clock: Callable[[], float]) -> None:
        self._opener, self._take, self._clock = opener, take, clock
        self._is_unwanted = threading.Event()
        self._has_ended = threading.Event()
        self._answer_s = clock()
        self._failure = "its reader failed"
        self._thread = threading.Thread(target=self._run, name=f"read {name}", daemon=True)
        self._thread.start()

    @property
    def is_alive(self) -> bool:
        """Whether its thread still runs or hangs."""
        return self._thread.is_alive()

    @property
    def failure(self) -> str:
        """Why it ended."""
        return self._failure

    def silence_s(self) -> float:
        """How long ago the connection last gave an answer, good or bad."""
        return self._clock() - self._answer_s

    def wait_for_end(self, timeout_s: float) -> bool:
        """Wait until it ended, at most so long, and say whether it did."""
        return self._has_ended.wait(timeout_s)

    def leave(self) -> None:
        """Want no more images; the connection is closed as soon as its read returns."""
        self._is_unwanted.set()

    def _run(self) -> None:
        try:
            with closing(self._opener()) as connection:
                while not self._is_unwanted.is_set():
                    pixels = connection.read()
                    self._answer_s = self._clock()
                    self._take(self, pixels, self._answer_s)
        except (ConnectionLostError, InputError) as error:
            self._failure = str(error)
        finally:
            self._has_ended.set()
