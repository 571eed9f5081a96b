"""A lens that is driven in a thread of its own; it rests as long as it works."""

import time
from collections.abc import Callable
from contextlib import closing

from tagmetry.errors import InputError
from tagmetry.live.rooms.lens.messages import LensPicture, LensTrace, StartLens
from tagmetry.live.rooms.lens.scene import lens_steps, true_depth_m
from tagmetry.live.rooms.lens.told import Trace, told_picture
from tagmetry.live.rooms.work import Work
from tagmetry.pipeline.lens import LensStep

_MOST_S = 600.0
_PICTURE_S = 0.3
Give = Callable[[LensTrace | LensPicture], None]


class Drive(Work):
    """Measures a marker until it is done or told to stop."""

    def __init__(self, asked: StartLens, give: Give) -> None:
        """Begin.

        Args:
            asked: Where the marker is.
            give: Takes what the page is told, in the thread of the drive.
        """
        self._asked, self._give = asked, give
        self._trace = Trace()
        self._pictured_s = float("-inf")
        super().__init__("lens")

    def _run(self) -> None:
        self._give(self._trace.told("the simulated camera's calibrations are being solved"))
        try:
            why = self._driven()
        except InputError as error:
            why = str(error)
        self._give(self._trace.told(why, "ended"))

    def _driven(self) -> str:
        """Return why it ended."""
        began_s = time.monotonic()
        with closing(lens_steps(self._asked)) as steps:
            worked_s = time.thread_time()
            for step in steps:
                self._tell(step)
                cost_s = time.thread_time() - worked_s
                if self._is_ending.wait(cost_s):
                    return "stopped by hand"
                if time.monotonic() - began_s > _MOST_S:
                    return f"stopped after {_MOST_S:g} s"
                worked_s = time.thread_time()
        return step.reason

    def _tell(self, step: LensStep) -> None:
        self._trace.take(step, true_depth_m(self._asked, step.image.time_s))
        self._give(self._trace.told(step.reason))
        if time.monotonic() - self._pictured_s >= _PICTURE_S:
            self._pictured_s = time.monotonic()
            self._give(told_picture(step))
