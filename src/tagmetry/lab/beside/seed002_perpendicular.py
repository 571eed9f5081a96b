"""What a perpendicular marker adds to four inclined ones, by pairs that share their noise."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import Mean, Sample, mean_of, rounded, sample
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.rigs.marker_floor import LayoutName
from tagmetry.lab.rows import Localization
from tagmetry.record.report import Cell, ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, RED, blank

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FOUR: LayoutName = "four inclined"
FIVE: LayoutName = "four and one perpendicular"

_QUANTITIES = {
    "radial_m": ("radial error", 1000.0, "mm"),
    "xy_m": ("error in XY", 1000.0, "mm"),
    "abs_z_m": ("error in Z", 1000.0, "mm"),
    "angle_deg": ("angular error", 1.0, "degrees"),
}
_REMARK = (
    "Corners are simulated, with the covariance that the detector's have, instead of found in "
    "rendered pictures: these cost a hundred times as much, and the gain is smaller than the "
    "scatter of a few of them. Both layouts of a pair have the same camera and the same noise "
    "of the four markers that they share."
)


def conclude(rows: Sequence[Localization]) -> Conclusions:
    """Return whether the fifth marker helps, by how much at each distance, and a figure."""
    everything = sample(rows)
    return Conclusions(
        checks=tuple(_check(everything, quantity) for quantity in _QUANTITIES),
        tables=(_table(everything),),
        figures=(_figure(everything),),
        remarks=(_REMARK,),
    )


def gains(rows: Sample, quantity: str) -> Array:
    """Return the error with four less that with five, of every pair, shape (n,)."""
    with_four, with_five = (_by_pair(rows.where(layout=name), quantity) for name in (FOUR, FIVE))
    return np.array([with_four[pair] - with_five[pair] for pair in with_four if pair in with_five])


def _by_pair(rows: Sample, quantity: str) -> dict[tuple[float, ...], float]:
    pairs = zip(*(rows.values(name) for name in ("distance_m", "yaw_deg", "repeat")), strict=True)
    return dict(zip(pairs, rows.values(quantity).tolist(), strict=True))


def _check(rows: Sample, quantity: str) -> Check:
    name, scale, unit = _QUANTITIES[quantity]
    gain = mean_of(scale * gains(rows, quantity))
    before = scale * float(np.nanmean(rows.where(layout=FOUR).values(quantity)))
    return Check(
        f"trend: one more marker, perpendicular, makes the {name} smaller, 1 to 7 m",
        "a paired difference above 0, with 95 % confidence",
        f"{_told(gain)} of {rounded(before):g} {unit}, {gain.count} pairs",
        bool(gain.low > 0),
    )


def _table(rows: Sample) -> ReportTable:
    names = [f"gain in {name}, {unit}" for name, _, unit in _QUANTITIES.values()]
    header = ("distance m", "radial mm with four", *names)
    lines = tuple((distance_m, *_line(part)) for distance_m, part in rows.by("distance_m").items())
    title = "What the perpendicular marker gains: mean of the pairs ± its 95 % confidence"
    return ReportTable("seed002_perpendicular", title, header, lines)


def _line(rows: Sample) -> list[Cell]:
    before = rounded(1000 * rows.where(layout=FOUR).mean("radial_m").mean)
    told = [
        _told(mean_of(scale * gains(rows, quantity)))
        for quantity, (_, scale, _) in _QUANTITIES.items()
    ]
    return [before, *told]


def _told(mean: Mean) -> str:
    return f"{rounded(mean.mean):g} ± {rounded(mean.half):g}"


def _figure(rows: Sample) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(7.0, 4.2)
        for name, color in ((FOUR, RED), (FIVE, BLUE)):
            groups = rows.where(layout=name).by("distance_m")
            means = [one.mean("radial_m") for one in groups.values()]
            y = 1000 * np.array([one.mean for one in means])
            half = 1000 * np.array([one.half for one in means])
            axes.plot(list(groups), y, "o-", color=color, ms=4, label=name)
            axes.fill_between(list(groups), y - half, y + half, color=color, alpha=0.2, lw=0)
        axes.set_xlabel("distance, m")
        axes.set_ylabel("radial error, mm")
        axes.legend(frameon=False)
        return figure

    told = "Mean radial error and its 95 % confidence band; the pairs' differences are far surer."
    return ReportFigure(
        "seed002_perpendicular", "With and without a perpendicular marker, by pairs", told, draw
    )
