"""Controls taken over from the auto modes, and given back as they were found, whatever happens."""

import signal
import threading
from collections.abc import Callable, Generator
from contextlib import ExitStack, contextmanager
from types import FrameType

from tagmetry.camera import Controls, restored
from tagmetry.camera.controls import RULED_BY

_Handler = Callable[[int, FrameType | None], object] | int | None


@contextmanager
def by_hand(controls: Controls) -> Generator[Controls]:
    """Switch auto focus and auto exposure off; at the end everything is as it was before.

    Also after an error or Ctrl-C; a Ctrl-C while the controls are given back waits until they are.

    Raises:
        ControlRefusedError: An auto mode cannot be switched off, or something not be given back.
    """
    with ExitStack() as ending:  # undone from last to first
        interrupts = _Interrupts()
        ending.callback(interrupts.let_through)
        ending.enter_context(restored(controls))
        ending.callback(interrupts.hold_back)
        for name in dict.fromkeys(RULED_BY.values()):
            if name in controls.available and controls.read(name) > 0:
                controls.write(name, 0.0)
        yield controls


class _Interrupts:
    """Ctrl-C, held back for a while; in other threads than the main one it never comes."""

    def __init__(self) -> None:
        self._before: _Handler = None
        self._held: list[int] = []

    def hold_back(self) -> None:
        """Only remember an interrupt."""
        if threading.current_thread() is threading.main_thread():
            self._before = signal.getsignal(signal.SIGINT)
            signal.signal(signal.SIGINT, self._remember)

    def let_through(self) -> None:
        """Let interrupts do what they did before, and raise the one that was held back."""
        if self._before is None:
            return
        signal.signal(signal.SIGINT, self._before)
        if self._held:
            signal.raise_signal(signal.SIGINT)

    def _remember(self, number: int, _: FrameType | None) -> None:
        self._held.append(number)
