"""Swarms drawn: what each task wants over time, and the robots' ways."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.beside.swarm_run import SwarmRun
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import BLUE, blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_RADIUS_M = 0.08  # of a robot


def swarm_figures(runs: Sequence[SwarmRun]) -> tuple[ReportFigure, ...]:
    """Return the curves of all runs, and the ways of one run of each kind."""
    return (_curves(runs), *(_paths(run) for run in _firsts(runs)))


def _firsts(runs: Sequence[SwarmRun]) -> list[SwarmRun]:
    """Return one run of each task and number of robots."""
    return list({(run.task, run.robots): run for run in reversed(runs)}.values())[::-1]


def _curves(runs: Sequence[SwarmRun]) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(8.4, 4.2)
        for n, run in enumerate(_firsts(runs)):
            label = f"{run.robots}, {run.task}"
            axes.plot(run.time_s, run.measure_m, color=f"C{n}", lw=1.2, label=label)
        axes.set(xlabel="time, s", ylabel="m", ylim=(0, None))
        axes.legend(fontsize=8, ncols=2)
        return figure

    return ReportFigure(
        "swarm_curves",
        "What each task wants",
        "Aggregate: mean distance from the middle. Disperse: to the nearest other. Formation: off "
        "the place beside the leader, who drives from 8 s on.",
        draw,
    )


def _paths(run: SwarmRun) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(8.4, 5.0)
        _drawn(axes, run)
        axes.set(xlabel="x, m", ylabel="y, m")
        axes.set_aspect("equal", adjustable="datalim")
        return figure

    return ReportFigure(
        f"swarm_{run.task}_{run.robots}",
        f"{run.robots} robots, {run.task}: their ways",
        "A thin line for each robot's way, a circle where it ends.",
        draw,
    )


def _drawn(axes: "Axes", run: SwarmRun) -> None:
    from matplotlib.patches import Circle

    for way in np.swapaxes(run.xy_m, 0, 1):
        axes.plot(*way.T, lw=0.7, alpha=0.8)
        axes.add_patch(Circle((way[-1, 0], way[-1, 1]), _RADIUS_M, fill=False, ec=BLUE, lw=1))
