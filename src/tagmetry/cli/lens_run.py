"""What `tagmetry lens scan` and `track` do: open the camera and its lens, and tell every image."""

from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from tagmetry.cli.options import first

if TYPE_CHECKING:
    from tagmetry.lens import ZoomLens
    from tagmetry.pipeline.lens import LensTask


@dataclass(frozen=True)
class Wanted:
    """What was asked for.

    Attributes:
        camera: Camera with controls.
        lens: Its lens file.
        size: Side of the marker, as it was typed.
        marker_id: Which marker; any, where None.
        family: Its family.
        tracks: Follow it after it was measured.
        images: End after so many.
    """

    camera: str
    lens: Path
    size: str
    marker_id: int | None
    family: str
    tracks: bool = False
    images: int | None = None


def run(wanted: Wanted, out: Path | None, *, json_: bool) -> None:
    """Measure a marker, and tell every image."""
    from tagmetry.cli.lens_trace import told
    from tagmetry.files.lens import load_lens
    from tagmetry.pipeline.lens import measure_marker
    from tagmetry.pipeline.lens.opened import opened

    known = load_lens(wanted.lens)
    with opened(wanted.camera) as source:
        task = _task(known.lens(source.controls.available), wanted)
        _tell_gaps(task)
        with closing(measure_marker(source, task, lag=known.lag, tracks=wanted.tracks)) as steps:
            told(first(steps, wanted.images), out, json_=json_)


def _task(lens: "ZoomLens", wanted: Wanted) -> "LensTask":
    from tagmetry.detect import Detector
    from tagmetry.files import resolve_family
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.lens import MarkerKind
    from tagmetry.pipeline.lens import LensTask

    one = resolve_family(wanted.family)
    marker = MarkerKind(parse_length_m(wanted.size), one.layout.side_cells)
    return LensTask(lens, Detector([one]), marker, wanted.marker_id)


def _tell_gaps(task: "LensTask") -> None:
    from tagmetry.cli.bank_report import gap_doubt

    for gap in task.lens.gaps:
        typer.echo(
            f"tagmetry: no calibration between focus {gap.low_focus:g} and {gap.high_focus:g}; "
            f"it is interpolated there{gap_doubt(gap)}",
            err=True,
        )
