"""The best focus at a depth, from images of a marker over a sweep of the focus."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import ControlledSource, VerifiedControls
from tagmetry.errors import InputError
from tagmetry.lens import FocusPeak, Lag, LensSetting, focus_peak, marker_blur_px
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.pipeline.lens.task import Finder
from tagmetry.sources.controls import by_hand

_COARSE = 13
_FINE = 9
_MOST_WAITED = 40


@dataclass(frozen=True)
class SweepImage:
    """One image of a sweep.

    Attributes:
        focus: Where it was taken.
        blur_px: Standard deviation of the marker's blur; NaN where the marker was not seen.
    """

    focus: float
    blur_px: float


def sweep_focus(
    source: ControlledSource,
    finder: Finder,
    side_cells: int,
    *,
    zoom_percent: float = 200.0,
    lag: Lag | None = None,
) -> Iterator[SweepImage]:
    """Give the blur of a marker that stands still: over the whole range, then around the best.

    Args:
        source: The camera.
        finder: Finds the marker; the sharpest one is taken where there are several.
        side_cells: Cells along its side.
        zoom_percent: Held during the sweep.
        lag: How late the camera's controls are.
    """
    with by_hand(VerifiedControls(source.controls)):
        drive = Drive(source, lag)
        control = drive.controls.available["focus"]
        coarse = [
            _looked(drive, finder, side_cells, LensSetting(zoom_percent, focus))
            for focus in np.linspace(control.least, control.most, _COARSE).round()
        ]
        yield from coarse
        step = (control.most - control.least) / (_COARSE - 1)
        best = min(_seen(coarse), key=lambda one: one.blur_px).focus
        around = best + np.linspace(-step, step, _FINE)
        for focus in sorted({control.nearest(float(value)) for value in around}):
            yield _looked(drive, finder, side_cells, LensSetting(zoom_percent, focus))


def best_focus(images: Sequence[SweepImage]) -> FocusPeak:
    """Return the sharpest focus of a sweep."""
    return focus_peak([one.focus for one in images], [one.blur_px for one in images])


def _seen(images: Sequence[SweepImage]) -> Sequence[SweepImage]:
    seen = [one for one in images if np.isfinite(one.blur_px)]
    if not seen:
        raise InputError(
            "the marker was seen at no focus; put it in the middle of the picture, nearer or with "
            "more zoom"
        )
    return seen


def _looked(drive: Drive, finder: Finder, side_cells: int, setting: LensSetting) -> SweepImage:
    drive.go(setting)
    taken = drive.take()
    for _ in range(_MOST_WAITED):
        if taken.is_settled:
            break
        taken = drive.take()
    pixels = taken.image.pixels
    blurs = [marker_blur_px(pixels, one, side_cells) for one in finder.detect(pixels)]
    known = [blur for blur in blurs if np.isfinite(blur)]
    return SweepImage(setting.focus, min(known, default=float("nan")))
