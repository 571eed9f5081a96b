"""Coming back beside what seed 004 says of its figures 12 and 13."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import Sample, difference, mean_of, rounded, sample, told_of
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed004 import seed004
from tagmetry.lab.rigs.robot_room import PLACES, RobotStand, room_map
from tagmetry.lab.rows import RobotPlace
from tagmetry.record.report import Cell, ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, GOLD, RED, blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SIZES_M = (0.16, 0.10)
_CLOSED_M = 0.01
_SHOWN = 20.0  # times as large the errors are drawn
_SETUP = (
    "Figure 11 tells no distances: the robot is 1.3 to 2.1 m from two of the three markers, which "
    "it sees from every place. It comes back to within 5 mm and 0.5 degrees; what is compared are "
    "its errors there, so the way back need not be exact."
)


def conclude(rows: Sequence[RobotPlace]) -> Conclusions:
    """Return whether the triangle closes, errors by place, and figures 12 and 13."""
    everything = sample(rows)
    return Conclusions(
        checks=(*_closed_checks(everything), _size_check(everything)),
        tables=(_table(everything),),
        figures=(*_maps(everything), _errors_figure(everything)),
        remarks=(_SETUP, *seed004().remarks),
    )


def _closed_checks(everything: Sample) -> Iterator[Check]:
    (words,) = seed004().words(12)
    for size_m in _SIZES_M:
        gap = mean_of(gaps_m(everything.ours.where(size_m=size_m)))
        yield Check(
            f"markers of {100 * size_m:.0f} cm, first against fourth place: {words}",
            f"at most {1000 * _CLOSED_M:.0f} mm apart",
            told_of(gap, 1000.0, "mm"),
            bool(gap.missing == 0 and gap.high <= _CLOSED_M),
        )


def _size_check(everything: Sample) -> Check:
    (words,) = seed004().words(13)
    large, small = (everything.ours.where(size_m=size_m) for size_m in _SIZES_M)
    gain = difference(small.values("place_m"), large.values("place_m"))
    largest = [1000 * float(np.nanmax(one.values("place_m"))) for one in (small, large)]
    return Check(
        f"trend: {words}",
        "a difference above 0, with 95 % confidence",
        f"{told_of(gain, 1000.0, 'mm')}; largest of all {largest[0]:.2f} and {largest[1]:.2f} mm",
        bool(gain.low > 0),
    )


def gaps_m(part: Sample) -> Array:
    """Return by how much the errors at the first and the fourth place differ, each round, (n,)."""
    first, fourth = (
        np.stack([one.values("x_m"), one.values("y_m")])
        for one in (part.where(place=0), part.where(place=len(PLACES) - 1))
    )
    return np.asarray(np.hypot(*(fourth - first)))


def _table(everything: Sample) -> ReportTable:
    header = (
        "method", "markers cm", "largest mean error of the place mm", "of the heading degrees",
        "first against fourth mm",
    )  # fmt: skip
    lines = tuple(
        _line(method, size_m, everything.where(method=method, size_m=size_m))
        for method in everything.methods
        for size_m in _SIZES_M
    )
    return ReportTable("seed004_repeat", "Figures 12 and 13: every method", header, lines)


def _line(method: str, size_m: float, part: Sample) -> tuple[Cell, ...]:
    places = part.by("place").values()
    place_m = max(one.mean("place_m").mean for one in places)
    heading_deg = max(one.mean("heading_deg").mean for one in places)
    numbers = (1000 * place_m, heading_deg, 1000 * mean_of(gaps_m(part)).mean)
    return (method, 100 * size_m, *map(rounded, numbers))


def _maps(everything: Sample) -> tuple[ReportFigure, ...]:
    def draw() -> "Figure":
        figure, _ = blank(8.8, 4.6)
        figure.clear()
        for axes, size_m in zip(figure.subplots(1, 2), _SIZES_M, strict=True):
            _draw_walls(axes, size_m)
            for one, color in ((everything.paper, RED), (everything.ours, BLUE)):
                _draw_places(axes, one.where(size_m=size_m), color)
            axes.set(xlabel="x, m", ylabel="y, m", title=f"{100 * size_m:.0f} cm")
            axes.set(aspect="equal", xlim=(-1.0, 1.4), ylim=(-0.8, 2.2))
        figure.axes[0].legend(fontsize=8)
        return figure

    return (
        ReportFigure(
            "seed004_figure12",
            "Figure 12: the robot's places",
            f"Errors {_SHOWN:.0f} times as large; the black triangle is the true one, dots are "
            f"single pictures.",
            draw,
        ),
    )


def _draw_walls(axes: "Axes", size_m: float) -> None:
    for marker in room_map(RobotStand("corner", size_m, place=0)).markers:
        axes.plot(*marker.p_world[:2, :2].T, color=GOLD, lw=3)
    corners = np.array(PLACES)[[0, 1, 2, 3]]
    axes.plot(corners[:, 0], corners[:, 1], "k-", lw=0.8)


def _draw_places(axes: "Axes", part: Sample, color: str) -> None:
    name = "ours" if color == BLUE else "the paper's steps"
    drawn = []
    for place, (x_m, y_m, _) in enumerate(PLACES):
        here = part.where(place=place)
        errors = np.stack([here.values("x_m"), here.values("y_m")], axis=1)
        points = np.array([x_m, y_m]) + _SHOWN * errors
        axes.plot(*points.T, ".", color=color, ms=2)
        drawn.append(np.nanmean(points, axis=0))
    axes.plot(*np.array(drawn).T, "o-", color=color, ms=4, lw=1, label=name)


def _errors_figure(everything: Sample) -> ReportFigure:
    def draw() -> "Figure":
        figure, _ = blank(8.8, 3.4)
        figure.clear()
        fields = (("heading_deg", 1.0, "direction, degrees"), ("place_m", 1000.0, "place, mm"))
        for axes, (field, scale, name) in zip(figure.subplots(1, 2), fields, strict=True):
            for size_m, color in zip(_SIZES_M, (BLUE, RED), strict=True):
                for part, line in ((everything.ours, "o-"), (everything.paper, "s--")):
                    places = part.where(size_m=size_m).by("place")
                    means = [scale * one.mean(field).mean for one in places.values()]
                    whose = "ours" if line == "o-" else "its steps"
                    axes.plot(
                        [int(place) + 1 for place in places], means, line, color=color, ms=4,
                        label=f"{100 * size_m:.0f} cm, {whose}",
                    )  # fmt: skip
            axes.set_yscale("log")
            axes.set_xticks([1, 2, 3, 4])
            axes.set(xlabel="place", ylabel=name)
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=2)
        return figure

    return ReportFigure(
        "seed004_figure13", "Figure 13: errors at the four places", "Mean over the rounds.", draw
    )
