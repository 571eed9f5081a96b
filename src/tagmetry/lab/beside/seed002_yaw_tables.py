"""Errors by distance, by method, and by what the covariances state."""

from collections.abc import Iterator

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import Sample, found_of, mean_of, rounded, told_of
from tagmetry.lab.beside.seed002_yaw_figures import SURFACES
from tagmetry.record.report import Cell, ReportTable


def by_distance(exact: Sample) -> ReportTable:
    """Return the errors of ours and of the paper's steps at every distance."""
    header = (
        "markers", "distance m", "ours: radial mm", "± mm", "XY mm", "Z mm", "angle degrees",
        "angle rad", "localized", "the paper's steps: radial mm", "± mm", "angle degrees",
        "localized",
    )  # fmt: skip
    rows = tuple(
        (layout, distance_m, *_ours(part.ours), *_theirs(part.paper))
        for layout in SURFACES.values()
        for distance_m, part in exact.where(layout=layout).by("distance_m").items()
    )
    return ReportTable("seed002_distance", "Errors by distance, over all yaws", header, rows)


def _ours(rows: Sample) -> Iterator[Cell]:
    radial, angle = rows.mean("radial_m"), rows.mean("angle_deg")
    yield rounded(1000 * radial.mean)
    yield rounded(1000 * radial.half)
    yield rounded(1000 * rows.mean("xy_m").mean)
    yield rounded(1000 * rows.mean("abs_z_m").mean)
    yield rounded(angle.mean)
    yield rounded(float(np.radians(angle.mean)))
    yield found_of(radial)


def _theirs(rows: Sample) -> Iterator[Cell]:
    radial = rows.mean("radial_m")
    yield rounded(1000 * radial.mean)
    yield rounded(1000 * radial.half)
    yield rounded(rows.mean("angle_deg").mean)
    yield found_of(radial)


def by_method(exact: Sample) -> ReportTable:
    """Return the radial error of every method, in mm, over 4 to 6 m."""
    rows = tuple(
        (method, *(_method_cell(exact, method, layout) for layout in SURFACES.values()))
        for method in exact.methods
    )
    title = "Radial error of every method, 4 to 6 m: mean ± its 95 % confidence, mm"
    return ReportTable("seed002_methods", title, ("method", *SURFACES.values()), rows)


def _method_cell(exact: Sample, method: str, layout: str) -> str:
    mean = exact.where(method=method, layout=layout).within(4, 6).mean("radial_m")
    return told_of(mean, 1000.0, "")


def consistency(everything: Sample) -> ReportTable:
    """Return whether stated covariances are right: 6 is the mean of chi-squared with 6 numbers."""
    rows = tuple(
        (look, layout, distance_m, rounded(float(np.nanmedian(found))), _mean_text(found))
        for look in ("simulator", "webcam")
        for layout in SURFACES.values()
        for distance_m, part in _settings(everything, look, layout)
        if np.isfinite(found := part.values("mahalanobis2")).any()
    )
    header = ("pictures", "markers", "distance m", "median (5.35 is right)", "mean (6 is right)")
    title = "Squared Mahalanobis distance of our errors by the stated covariances"
    return ReportTable("seed002_consistency", title, header, rows)


def _settings(everything: Sample, look: str, layout: str) -> Iterator[tuple[float, Sample]]:
    part = everything.ours.where(look=look, layout=layout).by("distance_m")
    yield from part.items()


def _mean_text(values: Array) -> str:
    mean = mean_of(values)
    return f"{rounded(mean.mean):g} ± {rounded(mean.half):g}"
