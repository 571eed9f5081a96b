"""What swarms come to: how soon, how near, and how much faster than real time."""

from collections.abc import Sequence

from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.beside.swarm_figures import swarm_figures
from tagmetry.lab.beside.swarm_run import LINK_M, SwarmRun, swarm_runs
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.rows import SwarmPlace
from tagmetry.record.report import ReportTable

_SPREAD_M, _OFF_M = 0.9 * 0.45, 0.03


def conclude(rows: Sequence[SwarmPlace]) -> Conclusions:
    """Return what must hold, a line for each run, curves and paths."""
    runs = swarm_runs(rows)
    return Conclusions(
        checks=tuple(check for run in runs for check in _checks(run)),
        tables=(_table(runs),),
        figures=swarm_figures(runs),
        remarks=(
            "More than 36 robots move in a hall of 6.4 by 3.4 m, the camera 5.2 m above it.",
            "Pictures are left out: markers' corners come with noise.",
            "Processor time is of all threads, on a machine that does other things as well.",
        ),
    )


def _checks(run: SwarmRun) -> tuple[Check, ...]:
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


def _goal(named: str, run: SwarmRun) -> Check:
    """Return whether the task was done."""
    last_m = float(run.measure_m[-1])
    if run.task == "aggregate":
        return Check(
            f"{named}: crowds in the end, of robots less than {1000 * LINK_M:.0f} mm apart",
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


def _table(runs: Sequence[SwarmRun]) -> ReportTable:
    header = (
        "task", "robots", "from, mm", "to, mm", "converged after, s", "nearest ever, mm",
        "contacts", "neighbours told", "times real time",
    )  # fmt: skip
    return ReportTable("swarm", "Swarms", header, tuple(map(_line, runs)))


def _line(run: SwarmRun) -> tuple[float | str, ...]:
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
