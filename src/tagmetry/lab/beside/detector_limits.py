"""Where every detector ends, how exact it is until there, and what ours must hold."""

from collections.abc import Iterator, Sequence

import numpy as np

from tagmetry.lab.beside.limit_figures import limit_figure
from tagmetry.lab.beside.limit_summary import ENOUGH, Limits, Looks, end_of, limits
from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.engines import OURS
from tagmetry.lab.rigs.limit_sweeps import SWEEPS
from tagmetry.lab.rows import Limit
from tagmetry.record.report import Cell, ReportTable

_MOST_OF_BOUND = 1.3
_DISTANCE2 = (6.4, 9.6)  # 8, by a fifth either way
_STARRED = "* Nothing harder was tried. At this value, and at all easier ones, 95 % are found."
_BOUND = (
    "The bound is the least root mean square error of a corner's coordinate that the noise allows, "
    "of the whole picture with unknown levels and blur, and exponent where that is varied. Motion "
    "and the noise of light are in it."
)
_POSES = (
    "Poses are computed from every engine's corners by one solver with equal weights, so that it "
    "is the corners that are compared."
)


def conclude(rows: Sequence[Limit]) -> Conclusions:
    """Return the checks of ours, the limits of all engines, and a table and figure for each."""
    run = limits(rows)
    return Conclusions(
        checks=tuple(_checks(run)) if OURS in run.engines else (),
        tables=(_limit_table(run), *(_exact_table(run, one) for one in run.variables)),
        figures=tuple(limit_figure(run, one) for one in run.variables),
        remarks=(_STARRED, _BOUND, _POSES, *_failures(rows)),
    )


def _checks(run: Limits) -> Iterator[Check]:
    ours = {v: run.looks(v, OURS) for v in run.variables}
    clear = {
        f"{v} {value:g}": one
        for v, looks in ours.items()
        for value, one in looks.items()
        if one.recall >= ENOUGH
    }
    if clear:
        yield _bound_check(clear)
        yield _covariance_check(clear)
    yield _recall_check(run)
    count = sum(one.false_positives for looks in ours.values() for one in looks.values())
    yield Check("tagmetry finds no marker where there is none", "0", str(count), count == 0)


def _bound_check(clear: dict[str, Looks]) -> Check:
    ratios = {name: one.corner_px / one.bound_px for name, one in clear.items()}
    worst = max(ratios, key=lambda name: ratios[name])
    middle = float(np.median(list(ratios.values())))
    return Check(
        "tagmetry's corners are near the bound wherever it finds nearly all markers",
        f"at most {_MOST_OF_BOUND} times the bound",
        f"{middle:.2f} in the middle, {ratios[worst]:.2f} at worst ({worst})",
        ratios[worst] <= _MOST_OF_BOUND,
    )


def _covariance_check(clear: dict[str, Looks]) -> Check:
    stated = {name: one.distance2 for name, one in clear.items()}
    low, high = (pick(stated, key=lambda name: stated[name]) for pick in (min, max))
    told = f"{stated[low]:.1f} ({low}) to {stated[high]:.1f} ({high})"
    holds = _DISTANCE2[0] <= stated[low] and stated[high] <= _DISTANCE2[1]
    return Check(
        "tagmetry's stated covariances are right there: the mean squared distance is 8",
        f"{_DISTANCE2[0]} to {_DISTANCE2[1]}",
        told,
        holds,
    )


def _recall_check(run: Limits) -> Check:
    """Return whether any other engine finds more markers at any value."""
    behind = {
        f"{engine} at {variable} {value:g}": one.recall - ours[value].recall
        for variable in run.variables
        if (ours := run.looks(variable, OURS))
        for engine in run.engines
        for value, one in run.looks(variable, engine).items()
    }
    worst = max(behind, key=lambda name: behind[name])
    told = f"{100 * behind[worst]:.0f} % fewer than {worst}" if behind[worst] > 0 else "never fewer"
    return Check(
        "tagmetry finds no fewer markers than any other, at any value",
        "never fewer",
        told,
        behind[worst] <= 0,
    )


def _limit_table(run: Limits) -> ReportTable:
    header = ("engine", *(SWEEPS[variable].limit for variable in run.variables))
    rows = tuple(
        (engine, *(str(end_of(run.looks(variable, engine))) for variable in run.variables))
        for engine in run.engines
    )
    title = "How far, how fast, how dark: where nearly all markers are still found"
    return ReportTable("detector_limits", title, header, rows)


def _exact_table(run: Limits, variable: str) -> ReportTable:
    """Return error and recall of every engine, by the value of what is varied."""
    columns = {engine: run.looks(variable, engine) for engine in run.engines}
    values = list(next(iter(columns.values())))
    header = (SWEEPS[variable].label, "bound px", *run.engines)
    rows = tuple((value, *_cells(columns, value)) for value in values)
    title = f"Corners' error px (markers found %), by {SWEEPS[variable].label}"
    return ReportTable(f"detector_{variable}", title, header, rows)


def _cells(columns: dict[str, dict[float, Looks]], value: float) -> Iterator[Cell]:
    looks = [column[value] for column in columns.values() if value in column]
    yield rounded(looks[0].bound_px)
    for one in looks:
        error = f"{rounded(one.corner_px):g}" if one.found else "-"
        yield f"{error} ({100 * one.recall:.0f})"


def _failures(rows: Sequence[Limit]) -> Iterator[str]:
    failed = {(row.engine, row.failure) for row in rows if row.failure}
    for engine, why in sorted(failed):
        yield f"{engine} gave no answer to some pictures: {why}"
