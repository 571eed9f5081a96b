"""More images of a marker at rest, where its turn is not as sure as asked.

Near the frontal view a small marker's turn drowns in noise: its outline hardly changes with it. The
depth needs none of this, and the setting stays as it is.
"""

from collections.abc import Iterator
from dataclasses import replace

from tagmetry.lens import Measured, together
from tagmetry.pipeline.lens.converge import agree
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import LensTask


def average(task: LensTask, drive: Drive, mean: Measured, reason: str = "") -> Iterator[LensStep]:
    """Give a step for each image until the turn is as sure as asked, or more would tell little.

    Args:
        task: What is measured.
        drive: The camera, at the setting of the measurement.
        mean: The measurement that has converged.
        reason: What there is to say of it.

    Yields:
        Final steps, each with the mean so far; none where there is nothing to do. An image in which
        the marker has moved or left is the last, and not in the mean.
    """
    while mean.turn_sd_rad > task.wanted_turn_rad and mean.images < task.most_averaged:
        step = task.look(drive.take(), "average")
        if step.found is None or not agree(mean, step.found):
            moved = f"the marker moves; this is the mean of {mean.images} images before it did"
            yield replace(step, found=mean, is_final=True, reason=moved)
            return
        mean = together(mean, step.found, task.lens, task.marker)
        yield replace(step, found=mean, is_final=True, reason=reason)
