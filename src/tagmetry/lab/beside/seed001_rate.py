"""Images per second beside figure 10 of seed 001."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rows import Rate
from tagmetry.record.report import ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, GOLD, RED, blank

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_NAMES = {"tagmetry": "ours, followed", "paper": "its steps, whole image"}
_COLORS = {"tagmetry": BLUE, "paper": RED}


def conclude(rows: Sequence[Rate]) -> Conclusions:
    """Return the rates beside the published ones."""
    return Conclusions(
        checks=tuple(_checks(rows)),
        tables=(_table(rows),),
        figures=(_figure(rows),),
        remarks=tuple(seed001().remarks[6:7]),
    )


def _checks(rows: Sequence[Rate]) -> list[Check]:
    printed = {one.robots: one.per_s for one in seed001().rates}
    ours = [row for row in rows if row.method == "tagmetry"]
    checks = [
        Check(
            f"images per second with {row.robots} robots, one core",
            f"more than the published {printed[row.robots]:g}",
            f"{1000 / row.cpu_ms:.0f}",
            1000 / row.cpu_ms > printed[row.robots],
        )
        for row in ours
        if row.robots in printed
    ]
    missed = [row for row in ours if row.found < row.robots]
    told = "every one in every image" if not missed else f"fewer with {missed[0].robots}"
    return [*checks, Check("robots found", "all", told, not missed)]


def _table(rows: Sequence[Rate]) -> ReportTable:
    printed = {one.robots: one.per_s for one in seed001().rates}
    lines = tuple(
        (
            row.robots,
            _NAMES[row.method],
            printed.get(row.robots, ""),
            rounded(1000 / row.cpu_ms),
            rounded(row.cpu_ms),
            rounded(row.cpu_p90_ms),
            rounded(row.found),
        )
        for row in sorted(rows, key=lambda one: (one.robots, one.method != "tagmetry"))
    )
    header = (
        "robots", "method", "published per s", "per s and core", "CPU ms", "90 % ms", "found",
    )  # fmt: skip
    return ReportTable("seed001_rate", "Figure 10: images per second", header, lines)


def _figure(rows: Sequence[Rate]) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(7.0, 4.4)
        for method, name in _NAMES.items():
            own = sorted((row for row in rows if row.method == method), key=lambda r: r.robots)
            counts, rates = [r.robots for r in own], [1000 / r.cpu_ms for r in own]
            axes.plot(counts, rates, "o-", color=_COLORS[method], label=name)
        printed = seed001().rates
        counts, rates = [one.robots for one in printed], [one.per_s for one in printed]
        axes.plot(counts, rates, "s:", color=GOLD, label="published")
        axes.set(xlabel="robots", ylabel="images per second and core", yscale="log")
        axes.set_ylim(bottom=5)
        axes.legend(fontsize=8)
        return figure

    return ReportFigure(
        "seed001_figure10",
        "Figure 10: images per second against robots",
        "Of the whole pipeline, by the processor time of an image.",
        draw,
    )
