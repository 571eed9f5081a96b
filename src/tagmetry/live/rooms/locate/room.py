"""The locate room: operators start and stop the walk; everybody may watch."""

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import cast

from tagmetry.errors import InputError
from tagmetry.live.messages import Asked, Told
from tagmetry.live.rooms.locate.messages import (
    LocateMarker,
    LocatePoint,
    LocateResidual,
    LocateTrace,
    StartLocate,
    StopLocate,
)
from tagmetry.live.rooms.locate.told import told_marker, told_point, told_residuals
from tagmetry.live.rooms.locate.walk import Looked, Walk, checked_noise_px
from tagmetry.live.rooms.room import Room
from tagmetry.localize import MarkerMap

_PERIOD_S = 0.2
_MOST_POINTS = 300


def locate_room(give: Callable[[Told], None]) -> Room:
    """Return the room.

    Args:
        give: Takes every message for the pages, from any thread.
    """
    desk = _Desk(give)
    return Room(takers={StartLocate: desk.start, StopLocate: desk.stop}, close=desk.close)


class _Desk:
    """Knows the one walk that goes on."""

    def __init__(self, give: Callable[[Told], None]) -> None:
        self._give = give
        self._walker: _Walker | None = None

    def start(self, asked: Asked) -> None:
        """Begin a walk."""
        noise_px = checked_noise_px(cast("StartLocate", asked).noise_px)
        if self._walker is not None and self._walker.is_running:
            raise InputError("the camera is being carried already; stop it first")
        self._walker = _Walker(noise_px, self._give)

    def stop(self, _: Asked) -> None:
        """Stop the walk."""
        if self._walker is None or not self._walker.is_running:
            raise InputError("the camera is not being carried")
        self._walker.end()

    def close(self) -> None:
        """End what runs."""
        if self._walker is not None:
            self._walker.end()
            self._walker.join()


class _Walker:
    """Carries the camera in a thread of its own; it rests as long as it works."""

    def __init__(self, noise_px: float, give: Callable[[Told], None]) -> None:
        self._noise_px, self._give = noise_px, give
        self._markers: tuple[LocateMarker, ...] = ()
        self._path: deque[LocatePoint] = deque(maxlen=_MOST_POINTS)
        self._residuals: tuple[LocateResidual, ...] = ()
        self._is_ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="locate", daemon=True)
        self._thread.start()

    @property
    def is_running(self) -> bool:
        return self._thread.is_alive()

    def end(self) -> None:
        self._is_ending.set()

    def join(self, patience_s: float = 5.0) -> None:
        self._thread.join(patience_s)

    def _run(self) -> None:
        self._tell("the room is being built")
        walk, worked_s = Walk(self._noise_px), time.thread_time()
        self._markers = tuple(told_marker(one) for one in walk.marker_map.markers)
        for looked in walk.looks():
            self._take(looked, walk.marker_map)
            cost_s = time.thread_time() - worked_s
            if self._is_ending.wait(max(_PERIOD_S - cost_s, cost_s)):
                break
            worked_s = time.thread_time()
        self._tell("stopped by hand" if self._is_ending.is_set() else "", is_running=False)

    def _take(self, looked: Looked, marker_map: MarkerMap) -> None:
        if not looked.pose.hypotheses:
            self._residuals = ()
            self._tell(looked.pose.why)
            return
        best = looked.pose.best
        self._path.append(told_point(looked, best))
        self._residuals = told_residuals(looked, best, marker_map)
        self._tell("")

    def _tell(self, why: str, *, is_running: bool = True) -> None:
        path, residuals = tuple(self._path), self._residuals
        self._give(LocateTrace(is_running, self._markers, path, residuals, why))
