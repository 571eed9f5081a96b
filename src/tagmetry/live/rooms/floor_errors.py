"""The error map of the simulated floor, measured when an operator asks, in a thread of its own."""

import threading
from collections.abc import Callable

from tagmetry.arena import ErrorMap
from tagmetry.errors import InputError
from tagmetry.live.messages import Asked, FloorErrors, MeasureErrors, Told
from tagmetry.live.rooms.room import Room
from tagmetry.pipeline.arena_twin.ready.floor_errors import GRID, floor_errors


def floor_errors_room(give: Callable[[Told], None]) -> Room:
    """Return what measures the floor's errors.

    Args:
        give: Takes what pages are told.
    """
    return Room(takers={MeasureErrors: _Measuring(give).take})


class _Measuring:
    """Measures one map at a time, each with other noise of the camera."""

    def __init__(self, give: Callable[[Told], None]) -> None:
        self._give = give
        self._thread: threading.Thread | None = None
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
        self._thread = threading.Thread(target=self._run, name="floor errors", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        self._give(told_errors(floor_errors(self._count)))


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
