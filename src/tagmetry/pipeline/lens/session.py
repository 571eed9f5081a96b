"""Find a marker, converge, and go on: the whole way, one step for each image.

The camera is left as it was found, also after an error or an interrupt.
"""

from collections.abc import Generator, Iterator, Sequence
from dataclasses import replace

from tagmetry.camera import ControlledSource, VerifiedControls
from tagmetry.lens import Lag, LensSetting, quick_scan
from tagmetry.pipeline.lens.average import average
from tagmetry.pipeline.lens.converge import converge
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.follow import follow
from tagmetry.pipeline.lens.search import search
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import LensTask
from tagmetry.sources.controls import by_hand

_ATTEMPTS = 5  # at a marker that is lost while the controls move


def measure_marker(
    source: ControlledSource,
    task: LensTask,
    *,
    lag: Lag | None = None,
    plan: Sequence[LensSetting] | None = None,
    tracks: bool = False,
) -> Generator[LensStep]:
    """Give a step for each image, from the first to the final measurement of a marker.

    Args:
        source: A camera with zoom and focus.
        task: What is measured.
        lag: How late the camera's controls are.
        plan: Settings to look through; by default `quick_scan`.
        tracks: Go on after the first measurement, following the marker.

    Yields:
        Steps; the last one is final, or says why there is no measurement.

    Raises:
        ControlError: A control is refused, reads back another value, or sticks.
    """
    with by_hand(VerifiedControls(source.controls)):
        drive = Drive(source, lag)
        if plan is None:
            plan = quick_scan(task.lens, task.marker, drive.commanded.focus)
        yield from _measured(task, drive, plan, tracks=tracks)


def measure_markers(
    source: ControlledSource, task: LensTask, ids: Sequence[int], *, lag: Lag | None = None
) -> Generator[LensStep]:
    """Give a step for each image while several markers are measured, one after the other.

    The camera begins each search where the last marker was, with what is near first.
    """
    with by_hand(VerifiedControls(source.controls)):
        drive = Drive(source, lag)
        for marker_id in ids:
            plan = quick_scan(task.lens, task.marker, drive.commanded.focus)
            wanted = replace(task, marker_id=marker_id)
            yield from _measured(wanted, drive, plan, tracks=False)


def _measured(
    task: LensTask, drive: Drive, plan: Sequence[LensSetting], *, tracks: bool
) -> Iterator[LensStep]:
    """Search and converge, again where the marker was lost on the way."""
    last = yield from _passed_on(search(task, drive, plan))
    for attempt in range(_ATTEMPTS):
        if last.found is None:
            return
        last = yield from _passed_on(converge(task, drive, last, keeps_zoom=attempt > 0))
        if last.found is not None:
            break
        last = yield from _passed_on(search(task, drive, plan, "reacquire"))
    if tracks and last.found is not None:
        yield from follow(task, drive, last.found, last.image.time_s)
    elif last.is_final and last.found is not None:
        yield from average(task, drive, last.found, last.reason)


def _passed_on(steps: Iterator[LensStep]) -> Generator[LensStep, None, LensStep]:
    """Give steps, and return the last one."""
    last = next(steps)
    yield last
    for last in steps:
        yield last
    return last
