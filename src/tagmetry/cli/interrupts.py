"""Ctrl-C between two images, never within one: what is written stays whole."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeVar

T = TypeVar("T")


@contextmanager
def held_back() -> Iterator[None]:
    """Hold a Ctrl-C back until the block is done; a second one goes through at once.

    Where Ctrl-C means something else already, or this is not the main thread, nothing changes.
    """
    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    pending: list[int] = []

    def remember(number: int, _: object) -> None:
        if pending:
            raise KeyboardInterrupt
        pending.append(number)

    signal.signal(signal.SIGINT, remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if pending:
        raise KeyboardInterrupt


def whole(items: Iterator[T]) -> Iterator[T]:
    """Give items, a Ctrl-C held back while the next one is made."""
    while True:
        with held_back():
            item = next(items, None)
        if item is None:
            return
        yield item
