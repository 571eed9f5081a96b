"""Whether the joint solution halves the weighted average's error over seed 002's grid.

The average of one marker is the marker's own pose: with the same corners nothing is gained there,
so our corners are judged where there are two or more.
"""

from collections.abc import Iterator

import numpy as np

from tagmetry.lab.beside.sample import Sample, rounded
from tagmetry.lab.beside.seed002_yaw_figures import SURFACES
from tagmetry.lab.conclusions import Check
from tagmetry.record.report import Cell, ReportTable

_HALF = 0.5


def half_checks(exact: Sample) -> Iterator[Check]:
    """Give one check beside the paper's own steps, and one beside its average of our corners."""
    several = exact.without(layout="one")
    for name, part, weighted in (
        ("the paper's weighted average of its own corners", exact, exact.paper),
        ("the weighted average of our corners, 2 or more markers", several, _weighted(several)),
    ):
        ratio = _rms(part.ours) / _rms(weighted)
        yield Check(
            f"rms radial error over all distances, yaws and layouts, by that of {name}",
            "at most half",
            f"{ratio:.3f}",
            bool(ratio <= _HALF),
        )


def halves(exact: Sample) -> ReportTable:
    """Return the same by number of markers."""
    rows = tuple(_row(layout, exact.where(layout=layout)) for layout in SURFACES.values())
    header = ("markers", "joint mm", "weighted mm", "the paper's steps mm", "joint by weighted")
    return ReportTable("seed002_halves", "Rms radial error, 1 to 7 m, all yaws", header, rows)


def _row(layout: str, part: Sample) -> tuple[Cell, ...]:
    errors_mm = [1000 * _rms(one) for one in (part.ours, _weighted(part), part.paper)]
    return (layout, *map(rounded, errors_mm), rounded(errors_mm[0] / errors_mm[1]))


def _weighted(part: Sample) -> Sample:
    return part.where(method="weighted")


def _rms(part: Sample) -> float:
    values = part.values("radial_m")
    return float(np.sqrt(np.nanmean(values**2))) if np.isfinite(values).any() else float("nan")
