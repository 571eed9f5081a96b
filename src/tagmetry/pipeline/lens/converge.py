"""From a first sighting to a measurement that is as good as the camera makes it.

Measure, choose the setting that promises the most at that depth, wait for it to show, measure
again; done when the setting stays, two images in a row agree, and the stated uncertainty is
reached or nothing promises less. A zoom that was never seen to do anything is tried once: a depth
is no better than the zoom that it was computed with.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tagmetry.camera.controls import ControlStuckError
from tagmetry.geometry import mahalanobis_squared
from tagmetry.lens import (
    LensSetting,
    Measured,
    Whereabouts,
    next_setting,
    together,
)
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.evidence import disobedience, jumps, shows_zoom, telling_zoom, tells
from tagmetry.pipeline.lens.exposing import exposes
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import LensTask

_AGREE = 27.9  # chi-squared with 3 degrees of freedom, passed once in 250,000 pairs
_MOST_LATE = 10  # images beyond the lag that a control may take to show
_MOST_MISSES = 4
_HARDLY_SEEN = 60.0  # grey values between black and white, below which exposing cannot wait


def converge(
    task: LensTask, drive: Drive, first: LensStep, *, keeps_zoom: bool = False
) -> Iterator[LensStep]:
    """Give a step for each image until the measurement is final, or the marker is lost.

    Args:
        task: What is measured.
        drive: The camera.
        first: In which the marker was seen, however blurred.
        keeps_zoom: Go to no less zoom than it was seen at: where it was lost with less before.

    Raises:
        ControlStuckError: The images do not show what was commanded.
    """
    if first.found is None:
        return
    state = _State(task, drive, first.found, first.setting.zoom_percent if keeps_zoom else 0.0)
    exposes(task, drive, first, least_contrast=_HARDLY_SEEN)
    drive.go(state.wanted(first.found))
    for left in reversed(range(task.most_images)):
        step = state.judged(task.look(drive.take(), "iterate"))
        if left == 0 and not step.is_final:
            step = replace(
                step, reason=f"not converged in {task.most_images} images; does it move?"
            )
        yield step
        if step.is_final or state.misses > _MOST_MISSES + drive.lag.images:
            return


class _State:
    """What the iteration remembers from image to image."""

    def __init__(
        self, task: LensTask, drive: Drive, first: Measured, least_zoom_percent: float
    ) -> None:
        self._task, self._drive, self._least_zoom_percent = task, drive, least_zoom_percent
        self._first: Measured | None = first
        self._newest: Measured | None = None  # the last one that should be settled
        self._elsewhere: Measured | None = None  # the last one at another setting
        self._last: Measured | None = None  # the last one at the present setting
        self._late = 0
        self._is_exposed = False
        self.misses = 0

    def wanted(self, found: Measured) -> LensSetting:
        """Return the setting that is best for where it was seen."""
        at = Whereabouts(np.asarray(found.T_camera_marker.translation), found.tilt_rad)
        lens = self._task.lens
        best = next_setting(lens, self._task.marker, at, self._drive.commanded)
        zoom_percent = max(best.zoom_percent, self._least_zoom_percent)
        return replace(best, zoom_percent=lens.zoom.nearest(zoom_percent))

    def judged(self, step: LensStep) -> LensStep:
        """Return the step with what it means, and command what follows from it."""
        if step.found is None:
            self.misses += 1
            return step
        self.misses = 0
        if not step.is_settled or not self._is_believed(step.found) or self._exposes(step):
            return step
        wanted = self.wanted(step.found)
        if wanted != self._drive.commanded:
            self._go(self._telling(wanted, step.found), step.found)
            return step
        before, self._last = self._last, step.found
        if before is None or not agree(before, step.found):
            return step
        if not self._drive.zoom_is_proven:
            self._go(telling_zoom(self._task.lens, step.found), step.found)
            return step
        both = together(before, step.found, self._task.lens, self._task.marker)
        return replace(step, found=both, is_final=True, reason=self._why_final(both))

    def _go(self, setting: LensSetting, found: Measured) -> None:
        self._elsewhere, self._last = found, None
        self._drive.go(setting)

    def _telling(self, wanted: LensSetting, found: Measured) -> LensSetting:
        """Return the setting, with a zoom that tells whether it shows as long as none has."""
        if self._drive.zoom_is_proven or tells(found.setting, wanted):
            return wanted
        return replace(wanted, zoom_percent=telling_zoom(self._task.lens, found).zoom_percent)

    def _is_believed(self, found: Measured) -> bool:
        return not self._is_surprised(found) and not self._is_late(found)

    def _is_surprised(self, found: Measured) -> bool:
        """Say whether an older command came through; then all are waited for, and none trusted."""
        before, self._newest = self._newest, found
        if before is None or not jumps(before, found):
            return False
        self._first = self._elsewhere = self._last = None
        self._drive.zoom_is_proven = False
        self._drive.later(_MOST_LATE)
        self._drive.wait(_MOST_LATE)
        return True

    def _is_late(self, found: Measured) -> bool:
        """Say whether the image does not show the commanded setting yet."""
        seen = disobedience(self._task.lens, self._elsewhere, found)
        if seen is None:
            self._drive.later(self._late)
            self._late = 0
            self._prove_zoom(found)
            return False
        self._late += 1
        if self._late > _MOST_LATE:
            raise ControlStuckError(
                f"{seen.control}: {seen.told}, {self._late} images later than the camera takes; "
                "the control sticks, or the lens is another than was measured"
            )
        return True

    def _prove_zoom(self, found: Measured) -> None:
        shown = [shows_zoom(one, found) for one in (self._first, self._elsewhere) if one]
        self._drive.zoom_is_proven |= True in shown

    def _exposes(self, step: LensStep) -> bool:
        """Correct the exposure once, in an image that is settled; say whether that was done."""
        if self._is_exposed:
            return False
        self._is_exposed = True
        return exposes(self._task, self._drive, step)

    def _why_final(self, found: Measured) -> str:
        reached = found.depth_sd_m <= self._task.wanted_share * found.depth_m
        return "" if reached else "converged; no setting promises less uncertainty than this"


def agree(before: Measured, now: Measured) -> bool:
    """Say whether two places differ by no more than the noise that both have."""
    moved_m = np.asarray(now.T_camera_marker.translation - before.T_camera_marker.translation)
    covariance = (before.pose.covariance + now.pose.covariance)[:3, :3]
    return bool(mahalanobis_squared(moved_m, covariance) < _AGREE)
