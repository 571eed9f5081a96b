"""What pages asked for, until the arena's thread takes it: bounded, in order, a stop before all."""

import threading
from collections import deque
from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.live.messages import Asked, Stop

_MOST = 100


@dataclass(frozen=True)
class Order:
    """What a page asked for.

    Attributes:
        page: Its number.
        asked: Its message.
    """

    page: int
    asked: Asked


class Orders:
    """A queue between threads. A stop makes void what was asked before it."""

    def __init__(self) -> None:
        self._waiting: deque[Order] = deque()
        self._lock = threading.Lock()

    def put(self, order: Order) -> None:
        """Append an order.

        Raises:
            InputError: Too many wait already; a stop is always taken.
        """
        with self._lock:
            if isinstance(order.asked, Stop):
                self._waiting.clear()
            if len(self._waiting) >= _MOST:
                raise InputError(f"{_MOST} commands wait already; try again")
            self._waiting.append(order)

    def take(self) -> list[Order]:
        """Return all that waits."""
        with self._lock:
            taken = list(self._waiting)
            self._waiting.clear()
        return taken
