"""Results as tables for a terminal of 100 columns."""

import math
from collections.abc import Iterator, Sequence

from rich.table import Table

from tagmetry.lab.bench.compare import Comparison
from tagmetry.lab.bench.costs import Cost
from tagmetry.lab.bench.goal import Goal
from tagmetry.lab.bench.goals import goals
from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row

_COLUMNS = (
    "p50 ms", "p99 ms", "ratio", "found", "false", "rms px", "bound", "pos %", "deg", "flip", "MiB",
)  # fmt: skip
NONE = "-"
_MOST_DECIMALS = 4


def tables(results: Results) -> Iterator[Table]:
    """Give one table for every number of threads, and one of what an image costs."""
    for threads in dict.fromkeys(row.threads for row in results.rows):
        yield _rows_table([row for row in results.rows if row.threads == threads], threads)
    if results.costs:
        yield _costs_table(results.costs)
    if wanted := goals(results):
        yield _goals_table(wanted)


def change_table(comparison: Comparison) -> Table:
    """Return the times and errors of two runs."""
    table = Table(title="compared with the former run", title_justify="left", box=None)
    for name in ("case", "engine"):
        table.add_column(name, no_wrap=True)
    for name in ("threads", "ms before", "now", "time", "found before", "now", "rms"):
        table.add_column(name, justify="right")
    for change in comparison.changes:
        before, now = change.before, change.now
        table.add_row(
            now.case,
            now.engine,
            str(now.threads),
            number(before.p50_ms),
            number(now.p50_ms),
            _times(change.time),
            found(before),
            found(now),
            _times(change.corner_rms),
        )
    return table


def number(value: float | None, digits: int = 3) -> str:
    """Return a number with so many digits that count."""
    if value is None:
        return NONE
    if value == 0:
        return "0"
    decimals = digits - 1 - math.floor(math.log10(abs(value)))
    return f"{value:.{min(max(decimals, 0), _MOST_DECIMALS)}f}"


def found(row: Row) -> str:
    """Return how many of how many markers were found."""
    return f"{row.found}/{row.expected}"


def cells(row: Row) -> tuple[str, ...]:
    """Return a row's numbers as texts, in the order of the columns."""
    return (
        number(row.p50_ms),
        number(row.p99_ms),
        _times(row.ratio),
        found(row),
        str(row.false_positives),
        number(row.corner_rms_px, 2),
        number(row.bound_px, 2),
        number(row.position_error_percent, 2),
        number(row.angle_error_deg, 2),
        NONE if row.flips is None else str(row.flips),
        number(row.memory_mib, 2),
    )


def title_of(threads: int, clock: str) -> str:
    """Return what a table of so many threads is called."""
    what = "processor time" if clock == "processor" else "time by the clock"
    return f"{threads} thread{'s' if threads > 1 else ''}, {what}"


def _rows_table(rows: Sequence[Row], threads: int) -> Table:
    table = Table(
        title=title_of(threads, rows[0].clock), title_justify="left", padding=(0, 0, 0, 1), box=None
    )
    table.add_column("engine", no_wrap=True)
    for name in _COLUMNS:
        table.add_column(name, justify="right", no_wrap=True)
    for case in dict.fromkeys(row.case for row in rows):
        of_case = [row for row in rows if row.case == case]
        note = " (by agreement)" if of_case[0].judged_by == "agreement" else ""
        table.add_row(f"[bold]{case}[/bold]{note}")
        for row in of_case:
            table.add_row(f" {row.engine}", *cells(row))
    return table


def failures(results: Results) -> list[str]:
    """Return in words which engines gave no answer."""
    return [f"{row.case}: {row.engine} {row.failure}" for row in results.rows if row.failure]


def _costs_table(all_costs: Sequence[Cost]) -> Table:
    table = Table(title="what an image costs", title_justify="left", box=None)
    table.add_column("engine")
    for name in ("threads", "ms/image", "ms/megapixel", "ms/marker", "misfit %"):
        table.add_column(name, justify="right")
    for cost in all_costs:
        table.add_row(
            cost.engine,
            str(cost.threads),
            number(cost.image_ms),
            number(cost.megapixel_ms),
            number(cost.marker_ms),
            number(cost.misfit_percent, 2),
        )
    return table


def _goals_table(all_goals: Sequence[Goal]) -> Table:
    table = Table(title="what is to hold", title_justify="left", box=None)
    table.add_column("goal")
    for name in ("measured", "wanted", "bound", ""):
        table.add_column(name, justify="right")
    for goal in all_goals:
        limit = f"{'>=' if goal.at_least else '<='} {number(goal.wanted)}"
        bound = "" if goal.bound is None else number(goal.bound)
        table.add_row(goal.name, number(goal.measured), limit, bound, goal.verdict)
    return table


def _times(value: float | None) -> str:
    return NONE if value is None else f"{number(value)}x"
