"""The locate room: operators start a walk, or choose images; everybody may watch."""

import time
from collections import deque
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import cast

from tagmetry.errors import InputError
from tagmetry.live.messages import Asked, Told
from tagmetry.live.rooms.locate.folder import Chosen, Folder
from tagmetry.live.rooms.locate.looked import Looked, Way
from tagmetry.live.rooms.locate.messages import (
    LocateImages,
    LocateMarker,
    LocatePoint,
    LocateResidual,
    LocateTrace,
    StartLocate,
    StopLocate,
)
from tagmetry.live.rooms.locate.told import told_marker, told_point, told_residuals
from tagmetry.live.rooms.locate.walk import Walk, checked_noise_px
from tagmetry.live.rooms.only import OnlyWork
from tagmetry.live.rooms.room import Room
from tagmetry.live.rooms.work import Work
from tagmetry.localize import MarkerMap

_PERIOD_S = 0.2
_MOST_POINTS = 300


def locate_room(give: Callable[[Told], None], maps: Path) -> Room:
    """Return the room.

    Args:
        give: Takes every message for the pages, from any thread.
        maps: Folder of maps, cameras and images.
    """
    desk = _Desk(give, Folder(maps))
    takers = {StartLocate: desk.start, LocateImages: desk.open, StopLocate: desk.stop}
    return Room(takers=takers, close=desk.close)


class _Desk:
    """Knows the one walk that goes on."""

    def __init__(self, give: Callable[[Told], None], folder: Folder) -> None:
        self._give, self._folder = give, folder
        self._walker: OnlyWork[_Walker] = OnlyWork(
            runs="the camera is being carried already; stop it first",
            rests="the camera is not being carried",
        )

    def start(self, asked: Asked) -> None:
        """Begin a walk."""
        noise_px = checked_noise_px(cast("StartLocate", asked).noise_px)
        self._begin(lambda: Walk(noise_px))

    def open(self, asked: Asked) -> None:
        """Begin with images that were taken."""
        chosen = Chosen(**vars(asked))
        for name in vars(chosen).values():
            self._folder.checked(name)
        self._begin(lambda: self._folder.opened(chosen))

    def stop(self, _: Asked) -> None:
        """Stop the walk."""
        self._walker.end()

    def close(self) -> None:
        """End what runs."""
        self._walker.close()

    def _begin(self, make: Callable[[], Way]) -> None:
        self._walker.begin(lambda: _Walker(make, self._give))


class _Walker(Work):
    """Goes a way in a thread of its own; it rests as long as it works."""

    def __init__(self, make: Callable[[], Way], give: Callable[[Told], None]) -> None:
        self._make, self._give = make, give
        self._markers: tuple[LocateMarker, ...] = ()
        self._path: deque[LocatePoint] = deque(maxlen=_MOST_POINTS)
        self._residuals: tuple[LocateResidual, ...] = ()
        super().__init__("locate")

    def _run(self) -> None:
        try:
            self._tell("the room is being built")
            self._go(self._make())
            why = "stopped by hand" if self._is_ending.is_set() else ""
        except (InputError, OSError) as error:
            why = str(error)
        self._tell(why, is_running=False)

    def _go(self, way: Way) -> None:
        self._markers = tuple(told_marker(one) for one in way.marker_map.markers)
        worked_s = time.thread_time()
        with closing(way.looks()) as looks:
            for looked in looks:
                self._take(looked, way.marker_map)
                cost_s = time.thread_time() - worked_s
                if self._is_ending.wait(max(_PERIOD_S - cost_s, cost_s)):
                    return
                worked_s = time.thread_time()

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
