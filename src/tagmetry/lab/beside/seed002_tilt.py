"""A marker that leans, beside what seed 002 says of its figures 8 to 12."""

from collections.abc import Iterator, Sequence

import numpy as np

from tagmetry.lab.beside.curves import Curve, Plot, curve_figure, surface_figure
from tagmetry.lab.beside.sample import Sample, difference, found_of, rounded, sample
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed002 import seed002
from tagmetry.lab.rows import Localization
from tagmetry.record.report import ReportFigure, ReportTable

_SMALL_DEG, _LARGE_DEG = 0.0, 30.0
_FAR_M = (4.0, 7.0)


def conclude(rows: Sequence[Localization]) -> Conclusions:
    """Return whether leaning helps, errors by lean, and figures 8, 9, 11 and 12."""
    everything = sample(rows)
    axes = ("pitch_deg", "roll_deg")
    return Conclusions(
        checks=tuple(_check(_about(everything, axis), axis) for axis in axes),
        tables=tuple(_table(_about(everything, axis), axis) for axis in axes),
        figures=tuple(figure for axis in axes for figure in _figures(everything, axis)),
        remarks=(seed002().remarks[2],),
    )


def _about(everything: Sample, axis: str, look: str = "simulator") -> Sample:
    """Return the pictures in which the marker leans about one axis, or not at all.

    Those in which it does not lean were made for either axis and serve both.
    """
    other = "roll_deg" if axis == "pitch_deg" else "pitch_deg"
    return everything.where(**{other: 0.0, "look": look})


def _check(rows: Sample, axis: str) -> Check:
    far = rows.ours.within(*_FAR_M).by(axis)
    leaning = [far[lean].values("radial_m") for lean in (-_LARGE_DEG, _LARGE_DEG)]
    flat = far[_SMALL_DEG].values("radial_m")
    gain = difference(flat, np.concatenate(leaning))
    return Check(
        f"trend: a marker that leans by {_LARGE_DEG:.0f} degrees in {axis[:-4]} is better than one "
        f"parallel to the image, {_FAR_M[0]:g} to {_FAR_M[1]:g} m",
        "a difference above 0, with 95 % confidence",
        f"{1000 * gain.mean:.0f} ± {1000 * gain.half:.0f} mm of {1000 * np.nanmean(flat):.0f} mm",
        bool(gain.low > 0),
    )


def _table(rows: Sample, axis: str) -> ReportTable:
    name = axis[:-4]
    header = (
        f"{name} degrees", "ours: radial mm", "± mm", "angle degrees", "localized",
        "the paper's steps: radial mm", "± mm", "angle degrees", "localized",
    )  # fmt: skip
    lines = []
    for lean_deg, part in rows.by(axis).items():
        cells: list[float | str] = [lean_deg]
        for one in (part.ours, part.paper):
            radial = one.mean("radial_m")
            numbers = 1000 * radial.mean, 1000 * radial.half, one.mean("angle_deg").mean
            cells += [*map(rounded, numbers), found_of(radial)]
        lines.append(tuple(cells))
    return ReportTable(
        f"seed002_{name}", f"Errors by {name}, over all distances", header, tuple(lines)
    )


def _figures(everything: Sample, axis: str) -> Iterator[ReportFigure]:
    surface, curve = (8, 9) if axis == "pitch_deg" else (11, 12)
    name = axis[:-4]
    yield surface_figure(surface, f"distance and {name}", _about(everything, axis), axis)
    real = _about(everything, axis, "webcam")
    both = (Curve("ours", real.ours), Curve("the paper's steps", real.paper, 1, dashed=True))
    plots = [Plot("radial_m", axis), Plot("angle_deg", axis)]
    yield curve_figure(curve, f"{name}, as a webcam sees it", both, plots)
