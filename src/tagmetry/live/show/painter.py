"""Pictures of the newest look, as large as pages are sent, in a thread of their own.

Where only corners are measured, the picture is painted with half the camera's pixels a side; a
picture that was measured is given as it is. A picture begins with a new look, never with one that
waited: what people see is as young as it can be.
"""

import threading
import time
from collections.abc import Callable, Sequence

import numpy as np

from tagmetry.arena import Robot
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.show.eye import Look, WatchedEye
from tagmetry.pipeline.arena_twin.ready.stage import floor, shot
from tagmetry.twin.rendering.binned import binned
from tagmetry.twin.robots.overhead import OverheadPictures

_PICTURE_S = 0.085  # between two pictures, at least: every third of 30 images a second
_REST = 2.0  # times the processor time of a picture, for the thread that runs the robots
_WAKE_S = 0.2

Paint = Callable[[Look], AnyPixels]


class Painter:
    """Makes pictures of the newest look."""

    def __init__(
        self,
        eye: WatchedEye,
        prepare: Callable[[], Paint],
        give: Callable[[Look, AnyPixels], None],
    ) -> None:
        """Begin.

        Args:
            eye: Whose newest look is shown.
            prepare: Returns what makes a picture of a look; called in the painter's thread.
            give: Takes every picture, in the painter's thread.
        """
        self._eye, self._prepare, self._give = eye, prepare, give
        self._is_closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="painter", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End after the picture that is being made; does not wait for it."""
        self._is_closing.set()

    def _run(self) -> None:
        paint = self._prepare()
        shown = self._eye.newest
        while not self._is_closing.is_set():
            look = self._eye.later(shown, _WAKE_S)
            if look is not None:
                shown = look
                began_s = time.thread_time()
                self._give(look, paint(look))
                self._rest(time.thread_time() - began_s)

    def _rest(self, cost_s: float) -> None:
        self._is_closing.wait(max(_PICTURE_S - cost_s, _REST * cost_s))


def painting(robots: Sequence[Robot]) -> Paint:
    """Return what paints the ready-made stage; its empty floor takes some seconds.

    Args:
        robots: In the order of the scenario.
    """
    pictures = OverheadPictures(floor(), robots, binned(shot()))
    rng = np.random.default_rng(0)
    return lambda look: pictures.take(look.Ts_world_robot, rng)


def measured(look: Look) -> AnyPixels:
    """Return the picture that was measured.

    Raises:
        InputError: Only corners were.
    """
    if look.pixels is None:
        raise InputError("this eye measures corners alone; there is no picture of its look")
    return look.pixels
