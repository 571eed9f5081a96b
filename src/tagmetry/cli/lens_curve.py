"""`tagmetry lens focus-curve`: one more pair of depth and best focus, and the laws of all."""

import csv
from pathlib import Path

import typer

from tagmetry.errors import InputError

_HEADER = ("depth_m", "focus", "sd")


def measured_pair(camera: str, depth_m: float, pairs: Path, family: str, zoom: float) -> None:
    """Sweep the focus and add the best to the file of pairs."""
    from tagmetry.detect import Detector
    from tagmetry.files import resolve_family
    from tagmetry.pipeline.lens.focus_curve import best_focus, sweep_focus
    from tagmetry.pipeline.lens.opened import opened

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
    from tagmetry.lens import fit_focus_laws
    from tagmetry.record.focus_curve import write_focus_curve

    depths_m, values, sds = _read(pairs)
    if len(set(depths_m)) < 3:
        typer.echo(f"{len(depths_m)} pairs in {pairs}; three depths are needed for a law")
        return
    fits = fit_focus_laws(depths_m, values, sds)
    for name, fit in fits.items():
        typer.echo(
            f"{name:<8} rms {fit.rms:.2f}, predicts a left-out pair to {fit.left_out_rms:.2f}: "
            f"{fit.law}"
        )
    if plot is not None:
        write_focus_curve(plot, depths_m, values, fits)
        typer.echo(f"wrote {plot}")


def _add(path: Path, depth_m: float, focus: float, sd: float) -> None:
    is_new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([_HEADER] if is_new else [])
        writer.writerow([f"{depth_m:.6g}", f"{focus:.4f}", f"{sd:.4f}"])


def _read(path: Path) -> tuple[list[float], list[float], list[float]]:
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    try:
        columns = [[float(row[name]) for row in rows] for name in _HEADER]
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"{path}: expected columns {', '.join(_HEADER)} of numbers; give another --pairs"
        ) from error
    return columns[0], columns[1], columns[2]
