"""`tagmetry lens focus-curve`: one more pair of depth and best focus, and the laws of all."""

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from tagmetry.cli.deviations import with_deviation
from tagmetry.errors import InputError

if TYPE_CHECKING:
    from tagmetry.lens import FocusFit

_HEADER = ("depth_m", "focus", "sd")


def measured_pair(camera: str, depth_m: float, pairs: Path, family: str, zoom: float) -> None:
    """Sweep the focus and add the best to the file of pairs, which is looked at first."""
    from tagmetry.detect import Detector
    from tagmetry.files import resolve_family
    from tagmetry.pipeline.lens.focus_curve import best_focus, sweep_focus
    from tagmetry.pipeline.lens.opened import opened

    read_pairs(pairs)
    one = resolve_family(family)
    images = []
    with opened(camera) as source:
        sweep = sweep_focus(source, Detector([one]), one.layout.side_cells, zoom_percent=zoom)
        for image in sweep:
            images.append(image)
            typer.echo(f"focus {image.focus:6.1f}  blur {image.blur_px:.2f} px")
    peak = best_focus(images)
    typer.echo(f"sharpest at {peak.focus:.2f} ± {peak.sd:.2f}, {peak.blur_px:.2f} px of blur")
    _add(pairs, depth_m, peak.focus, max(peak.sd, 1e-3))


def told_curve(pairs: Path, plot: Path | None) -> None:
    """Tell the laws that the pairs support, the one that predicts best first."""
    from tagmetry.files.lens import law_line
    from tagmetry.lens import fit_focus_laws
    from tagmetry.record.focus_curve import write_focus_curve

    depths_m, values, sds = read_pairs(pairs)
    if len(set(depths_m)) < 3:
        typer.echo(f"{len(depths_m)} pairs in {pairs}; three depths are needed for a law")
        return
    fits = fit_focus_laws(depths_m, values, sds)
    for name, fit in fits.items():
        typer.echo(
            f"{name:<8} rms {fit.rms:.2f}, predicts a left-out pair to {fit.left_out_rms:.2f}"
            f"{_numbers(fit)}"
        )
    typer.echo(f"for the lens file: {law_line(next(iter(fits.values())).law)}")
    if plot is not None:
        write_focus_curve(plot, depths_m, values, fits)
        typer.echo(f"wrote {plot}")


def _numbers(fit: "FocusFit") -> str:
    """Return a law's two numbers with their deviations; nothing for a spline."""
    from dataclasses import astuple

    if fit.covariance is None:
        return ""
    deviations = fit.covariance.diagonal() ** 0.5
    pairs = zip(astuple(fit.law), deviations, strict=True)
    return ": " + ", ".join(with_deviation(number, sd) for number, sd in pairs)


def _add(path: Path, depth_m: float, focus: float, sd: float) -> None:
    """Add a line; the file is whole at any moment."""
    from tagmetry.files import write_atomically

    rows = [*zip(*read_pairs(path), strict=True), (depth_m, focus, sd)]
    lines = [f"{depth_m:.6g},{focus:.4f},{sd:.4f}" for depth_m, focus, sd in rows]
    write_atomically(path, "\n".join([",".join(_HEADER), *lines, ""]))


def read_pairs(path: Path) -> tuple[list[float], list[float], list[float]]:
    """Return depths, focus values and deviations; none where there is no file yet.

    Raises:
        InputError: It is something else than a file of pairs.
    """
    from tagmetry.files.text import read_text

    if not path.exists():
        return [], [], []
    reader = csv.reader(read_text(path).splitlines())
    places = {name: place for place, name in enumerate(next(reader))}
    rows = [row for row in reader if row]
    try:
        columns = [
            [float(row[place]) for row in rows] for place in map(places.__getitem__, _HEADER)
        ]
    except (KeyError, IndexError, ValueError) as error:
        raise InputError(
            f"{path}: expected columns {', '.join(_HEADER)} of numbers; give another --pairs"
        ) from error
    return columns[0], columns[1], columns[2]
