"""What swarms come to: how soon, how near, and how much faster than real time."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.rows import SwarmPlace
from tagmetry.record.report import ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_NEAR_SHARE = 0.1  # of the whole change: from then on it has converged
_LINK_M = 0.32  # two bodies: so near are those of one crowd
_SPREAD_M, _OFF_M = 0.9 * 0.45, 0.03
_RADIUS_M = 0.08
_Key = tuple[str, int, int]


@dataclass(frozen=True, eq=False)
class _Run:
    """One run, second by second.

    Attributes:
        task: What the swarm does.
        time_s: Shape (t,).
        xy_m: Shape (t, n, 2).
        nearest_m: Of every robot, shape (t, n).
        off_m: From its place in the formation, shape (t, n).
        told: Neighbours of every robot, shape (t, n).
        touched: How many robots ever touched another.
        faster: Simulated time by processor time.
    """

    task: str
    time_s: Array
    xy_m: Array
    nearest_m: Array
    off_m: Array
    told: Array
    touched: int
    faster: float

    @property
    def robots(self) -> int:
        """How many."""
        return int(self.xy_m.shape[1])

    @property
    def measure_m(self) -> Array:
        """What the task wants small or large, shape (t,)."""
        if self.task == "disperse":
            return np.asarray(self.nearest_m.mean(axis=1))
        if self.task == "formation":
            return np.asarray(self.off_m[:, 1:].mean(axis=1))
        middle = self.xy_m.mean(axis=1, keepdims=True)
        return np.asarray(np.linalg.norm(self.xy_m - middle, axis=2).mean(axis=1))

    @property
    def crowds(self) -> int:
        """In how many crowds the robots stand at the end: chains of those that are near."""
        xy_m = self.xy_m[-1]
        near = np.linalg.norm(xy_m[:, None] - xy_m[None], axis=-1) < _LINK_M
        return int(connected_components(csr_array(near))[0])

    @property
    def converged_s(self) -> float:
        """Since when the measure is near what it is at the end."""
        measure_m = self.measure_m
        allowed_m = _NEAR_SHARE * np.abs(measure_m - measure_m[-1]).max()
        away = np.flatnonzero(np.abs(measure_m - measure_m[-1]) > allowed_m)
        return float(self.time_s[away[-1] + 1]) if len(away) else 0.0


def conclude(rows: Sequence[SwarmPlace]) -> Conclusions:
    """Return what must hold, a line for each run, curves and paths."""
    runs = _runs(rows)
    return Conclusions(
        checks=tuple(check for run in runs for check in _checks(run)),
        tables=(_table(runs),),
        figures=(_curves(runs), *(_paths(run) for run in _firsts(runs))),
        remarks=(
            "More than 36 robots move in a hall of 6.4 by 3.4 m, the camera 5.2 m above it.",
            "Pictures are left out: markers' corners come with noise.",
            "Processor time is of all threads, on a machine that does other things as well.",
        ),
    )


def _runs(rows: Sequence[SwarmPlace]) -> list[_Run]:
    keys = list(dict.fromkeys((row.task, row.robots, row.repeat) for row in rows))
    return [_run([row for row in rows if _key(row) == key]) for key in keys]


def _key(row: SwarmPlace) -> _Key:
    return row.task, row.robots, row.repeat


def _run(rows: Sequence[SwarmPlace]) -> _Run:
    def of(name: str) -> Array:
        values = np.array([getattr(row, name) for row in rows], dtype=np.float64)
        return values.reshape(-1, rows[0].robots)

    spent_s = max(rows[-1].cpu_s - rows[0].cpu_s, 1e-9)
    return _Run(
        rows[0].task,
        of("time_s")[:, 0],
        np.stack([of("x_m"), of("y_m")], axis=-1),
        of("nearest_m"),
        of("off_m"),
        of("told"),
        int(of("has_touched")[-1].sum()),
        float((rows[-1].time_s - rows[0].time_s) / spent_s),
    )


def _checks(run: _Run) -> tuple[Check, ...]:
    named = f"{run.robots} robots, {run.task}"
    is_large = run.robots > 24
    return (
        _goal(named, run),
        Check(f"{named}: contacts", "none", f"{run.touched} robots", run.touched == 0),
        Check(
            f"{named}: physics, camera's corners, link and control against real time",
            "faster, on one core" if not is_large else "stated",
            f"{run.faster:.2f} times",
            None if is_large else run.faster > 1,
        ),
    )


def _goal(named: str, run: _Run) -> Check:
    """Return whether the task was done."""
    last_m = float(run.measure_m[-1])
    if run.task == "aggregate":
        return Check(
            f"{named}: crowds in the end, of robots less than {1000 * _LINK_M:.0f} mm apart",
            "one",
            f"{run.crowds}",
            run.crowds == 1,
        )
    told, required, holds = {
        "disperse": (
            "nearest other, in the mean",
            f"at least {1000 * _SPREAD_M:.0f} mm",
            last_m >= _SPREAD_M,
        ),
        "formation": (
            "off its place at rest, in the mean",
            f"at most {1000 * _OFF_M:.0f} mm",
            last_m <= _OFF_M,
        ),
    }[run.task]
    return Check(f"{named}: {told}", required, f"{1000 * last_m:.0f} mm", bool(holds))


def _table(runs: Sequence[_Run]) -> ReportTable:
    header = (
        "task", "robots", "from, mm", "to, mm", "converged after, s", "nearest ever, mm",
        "contacts", "neighbours told", "times real time",
    )  # fmt: skip
    return ReportTable("swarm", "Swarms", header, tuple(map(_line, runs)))


def _line(run: _Run) -> tuple[float | str, ...]:
    return (
        run.task,
        run.robots,
        rounded(1000 * float(run.measure_m[0])),
        rounded(1000 * float(run.measure_m[-1])),
        rounded(run.converged_s),
        rounded(1000 * float(run.nearest_m.min())),
        run.touched,
        rounded(float(run.told.mean())),
        rounded(run.faster),
    )


def _firsts(runs: Sequence[_Run]) -> list[_Run]:
    """Return one run of each task and number of robots."""
    return list({(run.task, run.robots): run for run in reversed(runs)}.values())[::-1]


def _curves(runs: Sequence[_Run]) -> ReportFigure:
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


def _paths(run: _Run) -> ReportFigure:
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


def _drawn(axes: "Axes", run: _Run) -> None:
    from matplotlib.patches import Circle

    for way in np.swapaxes(run.xy_m, 0, 1):
        axes.plot(*way.T, lw=0.7, alpha=0.8)
        axes.add_patch(Circle((way[-1, 0], way[-1, 1]), _RADIUS_M, fill=False, ec=BLUE, lw=1))
