"""Follow a marker that moves: zoom and focus are set for where it will be when they take effect."""

from collections.abc import Iterator

import numpy as np

from tagmetry.lens import Measured, Motion, Whereabouts, next_setting, search_around
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.search import search
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import LensTask

_PERIOD_S = 1 / 30  # until two images have told it
_DOUBT_M = 0.02
_SURPRISE_M_S = 0.5  # by how much a lost marker's speed may have changed


def follow(
    task: LensTask, drive: Drive, first: Measured, time_s: float, *, searches: int = 3
) -> Iterator[LensStep]:
    """Give a step for each image, until the images end or the marker is lost for good.

    Args:
        task: What is followed.
        drive: The camera.
        first: Where it is.
        time_s: When that was.
        searches: How often in a row it is looked for over all depths before it is given up.

    Yields:
        Steps of phase `track`, of phase `reacquire` while it is lost.
    """
    motion = Motion.at_rest(time_s, np.asarray(first.T_camera_marker.translation))
    lost = 0
    while lost < searches:
        for step in _tracked(task, drive, motion, first):
            yield step
            if step.found is not None:
                motion, first, lost = _moved(motion, step), step.found, 0
        for step in _reacquired(task, drive, motion):
            yield step
            if step.found is not None:
                motion = Motion.at_rest(
                    step.image.time_s, np.asarray(step.found.T_camera_marker.translation)
                )
                first, lost = step.found, 0
                break
        else:
            lost += 1


def _tracked(task: LensTask, drive: Drive, motion: Motion, last: Measured) -> Iterator[LensStep]:
    """Give steps until an image does not show the marker."""
    previous_s = float(motion.times_s[-1])
    while True:
        step = task.look(drive.take(), "track")
        if step.found is not None:
            motion, last = _moved(motion, step), step.found
            period_s = step.image.time_s - previous_s
            previous_s = step.image.time_s
            ahead_s = (drive.lag.images + 1.5) * (period_s if 0 < period_s < 1 else _PERIOD_S)
            _aim(task, drive, motion.at(step.image.time_s + ahead_s), last.tilt_rad)
        yield step
        if step.found is None:
            return


def _moved(motion: Motion, step: LensStep) -> Motion:
    if step.found is None:
        return motion
    return motion.seen(step.image.time_s, np.asarray(step.found.T_camera_marker.translation))


def _aim(
    task: LensTask,
    drive: Drive,
    p_camera: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]",
    tilt_rad: float,
) -> None:
    """Command the setting for where the marker will be, unless the present one is as good."""
    nearest_m, farthest_m = task.lens.nearest_m, task.lens.farthest_m
    depth_m = float(np.clip(p_camera[2], nearest_m, farthest_m))
    at = Whereabouts(np.array([p_camera[0], p_camera[1], depth_m]), tilt_rad)
    drive.go(next_setting(task.lens, task.marker, at, drive.commanded))


def _reacquired(task: LensTask, drive: Drive, motion: Motion) -> Iterator[LensStep]:
    """Look for the marker where it should be, then everywhere."""
    depth_m = float(np.clip(motion.places_m[-1, 2], task.lens.nearest_m, task.lens.farthest_m))
    doubt_m = _DOUBT_M + _SURPRISE_M_S * 5 * _PERIOD_S
    plan = search_around(task.lens, task.marker, depth_m, doubt_m)
    yield from search(task, drive, plan, "reacquire")
