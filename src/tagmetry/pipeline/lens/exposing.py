"""The exposure, by the contrast of the marker that was seen."""

from tagmetry.lens import better_exposure_s, marker_levels
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import LensTask


def exposes(
    task: LensTask, drive: Drive, step: LensStep, least_contrast: float = float("inf")
) -> bool:
    """Correct the exposure by what an image shows of the marker, and say whether that was done.

    Args:
        task: What is measured.
        drive: The camera; one that lets no exposure be set is left as it is.
        step: In which the marker was seen.
        least_contrast: Between its black and white, grey values, that is good enough as it is.
    """
    control = drive.controls.available.get("exposure")
    if control is None or step.found is None:
        return False
    levels = marker_levels(step.image.pixels, step.found.detection, task.marker.side_cells)
    if levels.contrast >= least_contrast:
        return False
    present_s = drive.controls.read("exposure")
    better_s = better_exposure_s(levels, present_s, control)
    if better_s == present_s:
        return False
    drive.expose(better_s)
    return True
