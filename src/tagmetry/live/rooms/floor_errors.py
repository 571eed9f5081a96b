"""The error map of the simulated floor, measured when an operator asks.

It is rendered and measured by a program of its own (this module, run with a seed), which says it as
a message on its standard output: within the server it would take the robots' processor time.
"""

import subprocess
import sys
import threading
from collections.abc import Callable

from tagmetry.arena import ErrorMap
from tagmetry.errors import InputError
from tagmetry.live.client.reading import parse_told
from tagmetry.live.messages import Asked, FloorErrors, MeasureErrors, Told
from tagmetry.live.messages.wire import format_message
from tagmetry.live.rooms.room import Room
from tagmetry.pipeline.arena_twin.ready.floor_errors import GRID, floor_errors

_PATIENCE_S = 600.0


def floor_errors_room(give: Callable[[Told], None]) -> Room:
    """Return what measures the floor's errors.

    Args:
        give: Takes what pages are told.
    """
    measuring = _Measuring(give)
    return Room(takers={MeasureErrors: measuring.take}, close=measuring.close)


class _Measuring:
    """Measures one map at a time, each with other noise of the camera."""

    def __init__(self, give: Callable[[Told], None]) -> None:
        self._give = give
        self._thread: threading.Thread | None = None
        self._process: subprocess.Popen[str] | None = None
        self._count = 0

    def take(self, _: Asked) -> None:
        """Begin, and return at once.

        Raises:
            InputError: One is being measured.
        """
        if self._thread is not None and self._thread.is_alive():
            raise InputError("the error map is being measured already")
        self._count += 1
        self._give(FloorErrors(True, GRID.step_m, GRID.height_m, ()))
        self._process = started(self._count)
        self._thread = threading.Thread(target=self._wait, args=(self._process,), daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End what is being measured."""
        if self._process is not None and self._thread is not None:
            self._process.kill()
            self._thread.join()

    def _wait(self, process: "subprocess.Popen[str]") -> None:
        try:
            said, _ = process.communicate(timeout=_PATIENCE_S)
            told = parse_told(said)
        except (subprocess.TimeoutExpired, InputError):
            process.kill()
            told = None
        nothing = FloorErrors(False, GRID.step_m, GRID.height_m, ())
        self._give(told if isinstance(told, FloorErrors) else nothing)


def started(seed: int) -> "subprocess.Popen[str]":
    """Return the program that measures a map."""
    command = [sys.executable, "-m", __name__, str(seed)]
    return subprocess.Popen(  # noqa: S603 - this program itself
        command, stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True, encoding="utf-8"
    )


def told_errors(found: ErrorMap) -> FloorErrors:
    """Return what pages are told of a map."""
    numbers = [
        (x_m, y_m, error_x_m, error_y_m, sd_m)
        for (x_m, y_m), (error_x_m, error_y_m), sd_m in zip(
            found.true_m.tolist(),
            (found.measured_m - found.true_m).tolist(),
            found.sd_m.tolist(),
            strict=True,
        )
    ]
    return FloorErrors(False, GRID.step_m, GRID.height_m, tuple(numbers))


if __name__ == "__main__":
    sys.stdout.write(format_message(told_errors(floor_errors(int(sys.argv[1])))))
