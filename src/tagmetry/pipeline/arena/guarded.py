"""Controllers of users, kept from doing harm: one that raises or sleeps is named and given up.

Each runs in a thread of its own, so that one that never returns stops its own robot only.
"""

import threading
from queue import Empty, SimpleQueue

from tagmetry.arena.controllers import Controller, View
from tagmetry.arena.drive import STILL, Twist

_PATIENCE_S = 0.5


class Guarded:
    """A controller in its own thread.

    Attributes:
        fault: Why it was given up; None while it does well.
    """

    def __init__(self, controller: Controller, patience_s: float = _PATIENCE_S) -> None:
        """Start it.

        Args:
            controller: Whose answers are wanted.
            patience_s: How long one answer may take.
        """
        self.fault: str | None = None
        self._controller, self._patience_s = controller, patience_s
        self._views: SimpleQueue[View | None] = SimpleQueue()
        self._answers: SimpleQueue[Twist | str] = SimpleQueue()
        threading.Thread(target=self._run, name="controller", daemon=True).start()

    def __call__(self, view: View) -> Twist:
        """Return how to move; to stand still from its first fault on."""
        if self.fault is not None:
            return STILL
        self._views.put(view)
        try:
            answer = self._answers.get(timeout=self._patience_s)
        except Empty:
            answer = f"its controller did not answer within {self._patience_s:g} s"
        if isinstance(answer, Twist):
            return answer
        self.fault = answer
        self.close()
        return STILL

    def close(self) -> None:
        """Let its thread end."""
        self._views.put(None)

    def _run(self) -> None:
        while (view := self._views.get()) is not None:
            self._answers.put(self._answer(view))

    def _answer(self, view: View) -> Twist | str:
        try:
            twist = self._controller(view)
        except Exception as error:  # noqa: BLE001 - a user's code may raise whatever it likes
            return f"its controller raised {type(error).__name__}: {error}"
        return _checked(twist)


def _checked(twist: object) -> Twist | str:
    if not isinstance(twist, Twist):
        return f"its controller returned {type(twist).__name__}, a Twist is wanted"
    if not (abs(twist.speed_mps) < 100 and abs(twist.turn_rate_radps) < 1000):
        return f"its controller wants {twist.speed_mps} m/s and {twist.turn_rate_radps} rad/s"
    return twist
