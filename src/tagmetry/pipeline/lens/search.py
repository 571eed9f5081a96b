"""Look for a marker through a plan of settings: every image is looked at, stale ones too."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tagmetry.camera.controls import Control
from tagmetry.lens import LensSetting, bracket
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.step import LensStep, Phase
from tagmetry.pipeline.lens.task import NO_MARKER, LensTask


def search(
    task: LensTask, drive: Drive, plan: Sequence[LensSetting], phase: Phase = "scan"
) -> Iterator[LensStep]:
    """Give one step for each image until the marker is found, or the search is given up.

    In the first pass the motor does not stop: the next setting goes out before it arrives. In
    later ones it does, and each has another exposure, for light that hides the marker.

    Args:
        task: What is looked for.
        drive: The camera.
        plan: Settings in their order.
        phase: What the steps are called.

    Yields:
        Steps; the last one has the marker, or the reason why it was given up.
    """
    count, seen = 0, ""
    for number, exposure_s in enumerate(_exposures(drive)):
        if exposure_s is not None:
            drive.expose(exposure_s)
        for setting in plan:
            drive.go(setting)
            for step in _until_there(task, drive, phase, stops=number > 0):
                count += 1
                seen = step.reason if step.reason != NO_MARKER else seen
                is_last = step.found is None and count >= task.most_images
                yield replace(step, reason=_given_up(count, plan, seen)) if is_last else step
                if step.found is not None or is_last:
                    return
    reason = _given_up(count + 1, plan, seen)
    yield replace(task.look(drive.take(), phase), found=None, reason=reason)


def _until_there(task: LensTask, drive: Drive, phase: Phase, *, stops: bool) -> Iterator[LensStep]:
    """Give a step for each image until the camera is at its setting, or soon will be."""
    while True:
        taken = drive.take()
        yield task.look(taken, phase)
        if taken.is_settled if stops else drive.is_nearly_there:
            return


def _exposures(drive: Drive) -> Sequence[float | None]:
    """Return the exposure of each pass: first the present one, then the bracket around it."""
    control: Control | None = drive.controls.available.get("exposure")
    if control is None:
        return (None, None, None)
    present_s = drive.controls.read("exposure")
    return (None, *bracket(present_s, control))


def _given_up(count: int, plan: Sequence[LensSetting], seen: str) -> str:
    """Return why a search ends: by what was seen and is no good, or else by where nothing is."""
    if seen:
        return f"{seen}; given up after {count} images"
    return (
        f"no marker in {count} images at {len(plan)} settings; it is out of view, too near, too "
        "far or too oblique, or of another family"
    )
