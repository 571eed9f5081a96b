"""What a live source asks of a camera or stream: open it, read it, close it."""

from collections.abc import Callable
from typing import Protocol

from tagmetry.geometry.arrays import AnyPixels


class ConnectionLostError(Exception):
    """A camera or stream that was open gives no more images; the text says why."""


class Connection(Protocol):
    """An open camera or stream, used by one thread only."""

    def read(self) -> AnyPixels:
        """Wait for the next image and return it.

        Raises:
            ConnectionLostError: There will be none.
        """

    def close(self) -> None:
        """Let go of the device."""


Opener = Callable[[], Connection]  # raises InputError where it cannot be opened
