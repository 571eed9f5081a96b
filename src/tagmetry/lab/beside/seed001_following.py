"""Leader and follower beside figures 13 and 14 of seed 001."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rows import FollowingMoment
from tagmetry.record.report import ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, GOLD, RED, blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_GAP_M, _ALLOWED_M, _UP_TO_S = 0.20, 0.02, 0.1
_Key = tuple[float, bool]


def conclude(rows: Sequence[FollowingMoment]) -> Conclusions:
    """Return paths, distance errors and headings beside the published ones."""
    parts = _parts(rows)
    return Conclusions(
        checks=tuple(_checks(parts)),
        tables=(_table(parts),),
        figures=(_paths(parts), _distances(parts), _headings(parts)),
        remarks=tuple(seed001().following.remarks),
    )


def _parts(rows: Sequence[FollowingMoment]) -> dict[_Key, list[FollowingMoment]]:
    keys = sorted({(row.delay_s, row.slippery) for row in rows})
    return {key: [row for row in rows if (row.delay_s, row.slippery) == key] for key in keys}


def _checks(parts: dict[_Key, list[FollowingMoment]]) -> list[Check]:
    printed = seed001().following
    told = []
    for (delay_s, slippery), rows in parts.items():
        worst_m = float(np.abs(_errors_m(rows)).max())
        touched = any(row.touching for row in rows)
        floor = "where a wheel slips" if slippery else "on a clean floor"
        told.append(
            Check(
                f"distance error at a delay of {1000 * delay_s:g} ms {floor}, the worst",
                f"at most {_ALLOWED_M:g} m, no contact (published: {printed.worst_m:g} m)",
                f"{worst_m:.4f} m{', contact' if touched else ''}",
                worst_m <= _ALLOWED_M and not touched if delay_s <= _UP_TO_S else None,
            )
        )
    return told


def _table(parts: dict[_Key, list[FollowingMoment]]) -> ReportTable:
    printed = seed001().following
    lines: list[tuple[float | str, ...]] = [
        ("published", "", 1000 * printed.worst_m, 1000 * printed.mean_m, "", "", "")
    ]
    lines += [
        (f"{1000 * delay_s:g}", "slips once" if slippery else "clean", *_line(rows))
        for (delay_s, slippery), rows in parts.items()
    ]
    header = (
        "delay, ms", "floor", "worst, mm", "mean, mm", "nearest, mm", "heading by vision, rms mrad",
        "by odometry at the end, mrad",
    )  # fmt: skip
    return ReportTable(
        "seed001_following", "Figures 13 and 14: following at 20 cm", header, tuple(lines)
    )


def _line(rows: Sequence[FollowingMoment]) -> tuple[float, ...]:
    errors_mm = 1000 * np.abs(_errors_m(rows))
    true_rad = _values(rows, "true_heading_rad")
    vision = wrap_angle_rad(_values(rows, "seen_heading_rad") - true_rad)
    odometry = wrap_angle_rad(_values(rows, "odometry_heading_rad") - true_rad)
    ends = [
        n for n, row in enumerate(rows) if n + 1 == len(rows) or rows[n + 1].time_s < row.time_s
    ]
    return (
        rounded(float(errors_mm.max())),
        rounded(float(errors_mm.mean())),
        rounded(1000 * float(_values(rows, "gap_m").min())),
        rounded(1000 * float(np.sqrt((vision**2).mean()))),
        rounded(1000 * float(np.abs(odometry[ends]).mean())),
    )


def _errors_m(rows: Sequence[FollowingMoment]) -> Array:
    return _values(rows, "gap_m") - _GAP_M


def _values(rows: Sequence[FollowingMoment], name: str) -> Array:
    return np.array([getattr(row, name) for row in rows], dtype=np.float64)


def _first(rows: Sequence[FollowingMoment]) -> list[FollowingMoment]:
    return [row for row in rows if row.repeat == rows[0].repeat]


def _paths(parts: dict[_Key, list[FollowingMoment]]) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(8.4, 4.2)
        rows = _first(next(part for (_, slippery), part in parts.items() if slippery))
        for names, color, label in (
            (("leader_x_m", "leader_y_m"), BLUE, "leader"),
            (("follower_x_m", "follower_y_m"), RED, "follower"),
        ):
            x_m, y_m = (_values(rows, name) for name in names)
            seconds = np.flatnonzero(np.diff(np.floor(_values(rows, "time_s")), prepend=-1))
            axes.plot(x_m, y_m, color=color, lw=1, label=label)
            axes.plot(x_m[seconds], y_m[seconds], ".", color=color, ms=5)
        axes.set(xlabel="x, m", ylabel="y, m")
        axes.set_aspect("equal", adjustable="datalim")
        axes.legend(fontsize=8)
        return figure

    return ReportFigure(
        "seed001_figure13a",
        "Figure 13 a: paths of leader and follower, a dot each second",
        "The follower is pulled along a spring, so it cuts the loop as the paper's does.",
        draw,
    )


def _distances(parts: dict[_Key, list[FollowingMoment]]) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(8.4, 3.6)
        for n, ((delay_s, slippery), rows) in enumerate(parts.items()):
            if slippery:
                continue
            label = f"{1000 * delay_s:g} ms"
            _line_of(axes, _first(rows), 1000 * _errors_m(_first(rows)), f"C{n // 2}", label)
        worst_mm = 1000 * seed001().following.worst_m
        axes.axhline(worst_mm, color="0.5", ls=":", lw=1)
        axes.axhline(-worst_mm, color="0.5", ls=":", lw=1)
        axes.set(xlabel="time, s", ylabel="distance error, mm")
        axes.legend(fontsize=8, title="delay")
        return figure

    return ReportFigure(
        "seed001_figure13b",
        "Figure 13 b: error of the distance of 20 cm, on a clean floor",
        "Dotted: the paper's largest error, 42 mm, which it has nearly all the time.",
        draw,
    )


def _headings(parts: dict[_Key, list[FollowingMoment]]) -> ReportFigure:
    def draw() -> "Figure":
        figure, _ = blank(8.4, 5.2)
        figure.clear()
        above, below = figure.subplots(2, 1, sharex=True)
        rows = _first(next(part for (_, slippery), part in parts.items() if slippery))
        vision, odometry = (
            _values(rows, name) for name in ("seen_heading_rad", "odometry_heading_rad")
        )
        _line_of(above, rows, np.unwrap(vision), BLUE, "by vision")
        _line_of(above, rows, np.unwrap(odometry), GOLD, "by odometry")
        _line_of(below, rows, 1000 * wrap_angle_rad(vision - odometry), RED, "")
        above.set_ylabel("heading, rad")
        above.legend(fontsize=8)
        below.set(xlabel="time, s", ylabel="difference, mrad")
        return figure

    return ReportFigure(
        "seed001_figure14",
        "Figure 14: the leader's heading by vision and by odometry, and their difference",
        "The step of the difference is a wheel that slips; the camera sees it, the wheels do not.",
        draw,
    )


def _line_of(
    axes: "Axes", rows: Sequence[FollowingMoment], values: Array, color: str, label: str
) -> None:
    axes.plot(_values(rows, "time_s"), values, color=color, lw=1, label=label)
