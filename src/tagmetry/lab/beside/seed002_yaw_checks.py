"""What seed 002 states of distance, yaw and number of markers, held against ours."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.lab.beside.sample import Mean, Sample, difference, rounded, told_of
from tagmetry.lab.conclusions import Check
from tagmetry.lab.published.seed002 import Statement, seed002

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


def every_check(exact: Sample) -> Iterator[Check]:
    """Give a check of every statement, and of every trend."""
    for one in seed002().statements:
        yield from _checks(exact, one)
    for trend in _trends(exact):
        yield _trend_check(trend)


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
