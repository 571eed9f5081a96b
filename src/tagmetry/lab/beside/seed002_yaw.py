"""Distance, yaw and number of markers beside what seed 002 says of its figures."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.curves import Curve, Plot, curve_figure, surface_figure
from tagmetry.lab.beside.sample import (
    Mean,
    Sample,
    difference,
    found_of,
    mean_of,
    rounded,
    sample,
    told_of,
)
from tagmetry.lab.beside.sights import sights_figure
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed002 import Statement, seed002
from tagmetry.lab.rows import Localization
from tagmetry.record.calibration_report.figures import ReportFigure
from tagmetry.record.calibration_report.tables import Cell, ReportTable

_SURFACES = {4: "one", 14: "two", 16: "four", 20: "four inclined", 22: "four and one perpendicular"}
_MEAN_OF_NORMAL = float(np.sqrt(2 / np.pi))  # of |x| where x has the standard deviation 1
_TRENDS = (
    ("farther is worse (one marker, 7 m against 1 m)", ("one", 7, 7), ("one", 1, 1)),
    ("two markers are better than one, 5 to 7 m", ("one", 5, 7), ("two", 5, 7)),
    ("four are better than two, 5 to 7 m", ("two", 5, 7), ("four", 5, 7)),
    ("four inclined are better than flat, 5 to 7 m", ("four", 5, 7), ("four inclined", 5, 7)),
    (
        "one more, perpendicular, is better, 5 to 7 m",
        ("four inclined", 5, 7),
        ("four and one perpendicular", 5, 7),
    ),
)
"""In words; what is said to be worse, and what better: layout, from m, to m."""

_SETUP = (
    "The paper tells neither side nor focal length nor inclination: markers of 200 mm, 60 degrees "
    "of view (554 px) and 40 degrees are taken. Simulator: 0.5 px of blur, noise of 1 grey value; "
    "webcam: 1 px, 4 grey values, JPEG. The camera stands up to 5 mm and 0.5 degrees off at random."
)

_COVARIANCE = (
    "Stated covariances are too large on the simulator's clean pictures (the mean squared "
    "Mahalanobis distance is below 6), and too small for small markers in JPEG pictures, whose "
    "noise is not independent from pixel to pixel."
)


def conclude(rows: Sequence[Localization]) -> Conclusions:
    """Return the statements, the trends, every method, and figures 4 to 6 and 13 to 25."""
    everything = sample(rows)
    exact = everything.where(look="simulator")
    return Conclusions(
        checks=(
            *(check for one in seed002().statements for check in _checks(exact, one)),
            *(_trend_check(trend) for trend in _trends(exact)),
        ),
        tables=(_by_distance(exact), _by_method(exact), _consistency(everything)),
        figures=tuple(_figures(everything, exact)),
        remarks=(_SETUP, _COVARIANCE, *seed002().remarks[:3], seed002().remarks[4]),
    )


def _checks(exact: Sample, stated: Statement) -> Iterator[Check]:
    """Give one check, or for an angle two: as degrees, and as the radians that may be meant."""
    ours = exact.ours.where(layout=stated.layout).within(stated.from_m, stated.to_m)
    if stated.quantity != "angle_deg":
        yield _length_check(ours, stated)
        return
    worst = _worst(ours, "angle_deg")
    yield _angle_check(ours, stated, worst)
    in_radians = float(np.degrees(stated.at_most))
    yield Check(
        f"{stated.layout}: the same taken as radians",
        f"at most {stated.at_most} rad = {in_radians:.3g} degrees",
        told_of(worst, 1.0, "degrees"),
        _reaches(worst, in_radians),
    )


def _length_check(ours: Sample, stated: Statement) -> Check:
    worst = _worst(ours, stated.quantity)
    return Check(
        f"{stated.layout}: {stated.words}",
        f"at most {1000 * stated.at_most:.0f} mm",
        told_of(worst, 1000.0, "mm"),
        _reaches(worst, stated.at_most),
    )


def _angle_check(ours: Sample, stated: Statement, worst: Mean) -> Check:
    """Return the check in degrees; nothing is asked of it where the corners cannot tell so much."""
    holds: bool | None = _reaches(worst, stated.at_most)
    told = told_of(worst, 1.0, "degrees")
    possible = _MEAN_OF_NORMAL * np.degrees(
        max(one.mean("sd_angle_rad").mean for one in ours.by("distance_m").values())
    )
    if not holds and possible > stated.at_most:
        holds = None
        told += f"; the noise of the corners alone makes it {possible:.3f} degrees"
    return Check(
        f"{stated.layout}: {stated.words}", f"at most {stated.at_most} degrees", told, holds
    )


def _worst(rows: Sample, quantity: str) -> Mean:
    """Return the largest mean over yaw and repeats at any distance."""
    means = [one.mean(quantity) for one in rows.by("distance_m").values()]
    return max(means, key=lambda one: (one.missing, one.high))


def _reaches(mean: Mean, bound: float) -> bool:
    return bool(mean.missing == 0 and mean.high <= bound)


@dataclass(frozen=True)
class Trend:
    """A difference that the paper says there is.

    Attributes:
        told: In words.
        change: Error of what is said to be worse less that of what is said to be better, m.
        of: Mean error of what is said to be worse, m.
    """

    told: str
    change: Mean
    of: float


def _trends(exact: Sample) -> Iterator[Trend]:
    for told, worse, better in _TRENDS:
        values = [
            exact.ours.where(layout=layout).within(from_m, to_m).values("radial_m")
            for layout, from_m, to_m in (worse, better)
        ]
        yield Trend(told, difference(*values), float(np.nanmean(values[0])))


def _trend_check(trend: Trend) -> Check:
    mean = trend.change
    return Check(
        f"trend: {trend.told}",
        "a difference above 0, with 95 % confidence",
        f"{told_of(mean, 1000.0, 'mm')} of {rounded(1000 * trend.of):g} mm",
        bool(mean.low > 0),
    )


def _by_distance(exact: Sample) -> ReportTable:
    header = (
        "markers", "distance m", "ours: radial mm", "± mm", "XY mm", "Z mm", "angle degrees",
        "angle rad", "localized", "the paper's steps: radial mm", "± mm", "angle degrees",
        "localized",
    )  # fmt: skip
    rows = tuple(
        (layout, distance_m, *_ours(part.ours), *_theirs(part.paper))
        for layout in _SURFACES.values()
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


def _by_method(exact: Sample) -> ReportTable:
    """Return the radial error of every method, in mm, over 4 to 6 m."""
    rows = tuple(
        (method, *(_method_cell(exact, method, layout) for layout in _SURFACES.values()))
        for method in exact.methods
    )
    title = "Radial error of every method, 4 to 6 m: mean ± its 95 % confidence, mm"
    return ReportTable("seed002_methods", title, ("method", *_SURFACES.values()), rows)


def _method_cell(exact: Sample, method: str, layout: str) -> str:
    mean = exact.where(method=method, layout=layout).within(4, 6).mean("radial_m")
    return told_of(mean, 1000.0, "")


def _consistency(everything: Sample) -> ReportTable:
    """Return whether stated covariances are right: 6 is the mean of chi-squared with 6 numbers."""
    rows = tuple(
        (look, layout, distance_m, rounded(float(np.nanmedian(found))), _mean_text(found))
        for look in ("simulator", "webcam")
        for layout in _SURFACES.values()
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


def _figures(everything: Sample, exact: Sample) -> Iterator[ReportFigure]:
    yield sights_figure()
    real = everything.where(look="webcam")
    yield surface_figure(4, "one marker", exact.where(layout="one"), "yaw_deg")
    yield _pair(5, "one marker, as a webcam sees it", _both(real), "distance_m")
    yield _pair(6, "one marker, as a webcam sees it", _both(real), "yaw_deg")
    for number, layout in list(_SURFACES.items())[1:3]:
        yield surface_figure(number, f"{layout} markers", exact.where(layout=layout), "yaw_deg")
    counts = _layouts(exact, "one", "two", "four")
    yield _pair(17, "1, 2 and 4 markers", counts, "distance_m")
    yield _pair(18, "1, 2 and 4 markers", counts, "yaw_deg")
    for number, layout in list(_SURFACES.items())[3:]:
        yield surface_figure(number, layout, exact.where(layout=layout), "yaw_deg")
    planes = _layouts(exact, "four inclined", "four and one perpendicular")
    yield _pair(23, "with and without a perpendicular marker", planes, "distance_m")
    yield _pair(24, "with and without a perpendicular marker", planes, "yaw_deg")
    plots = [Plot(e, x) for e in ("xy_m", "abs_z_m") for x in ("distance_m", "yaw_deg")]
    yield curve_figure(25, "XY and Z apart", planes, plots)


def _pair(number: int, title: str, curves: Sequence[Curve], against: str) -> ReportFigure:
    return curve_figure(
        number, title, curves, [Plot("radial_m", against), Plot("angle_deg", against)]
    )


def _both(rows: Sample) -> tuple[Curve, ...]:
    return Curve("ours", rows.ours), Curve("the paper's steps", rows.paper, 1, dashed=True)


def _layouts(exact: Sample, *names: str) -> tuple[Curve, ...]:
    """Return ours and the paper's steps for layouts, with what the paper says of them."""
    stated = seed002().statements
    ours = [
        Curve(
            f"{name}, ours",
            exact.ours.where(layout=name),
            color,
            stated=tuple(one for one in stated if one.layout == name),
        )
        for color, name in enumerate(names)
    ]
    theirs = [
        Curve(f"{name}, its steps", exact.paper.where(layout=name), color, dashed=True)
        for color, name in enumerate(names)
    ]
    return (*ours, *theirs)
