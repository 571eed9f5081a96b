"""The report as one page: no script, nothing from elsewhere, readable in light and dark."""

from collections.abc import Sequence
from html import escape

from tagmetry import __version__
from tagmetry.lab.conclusions import Check
from tagmetry.lab.report.chapter import Chapter
from tagmetry.lab.report.text import verdict
from tagmetry.record.report import Cell, ReportTable
from tagmetry.record.report.html import (
    cell_class,
    document,
    figure_html,
    list_html,
    titled_table_html,
)

_MORE_STYLE = """
main { max-width: 72rem; }
.yes { color: #00724f; font-weight: 600; } .no { color: #c03a00; font-weight: 600; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(28rem, 1fr)); gap: 1rem; }
@media (prefers-color-scheme: dark) { .yes { color: #4cc38a; } .no { color: #ff8a5c; } }
@media (max-width: 34rem) { .figures { grid-template-columns: 1fr; } }
"""
_GOOD = {"yes", "better", "equal", "holds", "equal, at its resolution"}
_BAD = {"no", "worse", "FAILS"}


def page(told: Sequence[Chapter]) -> str:
    """Return the page of all experiments."""
    run = [one for one in told if one.origin is not None]
    body = f"{_header(told)}{''.join(map(_section, run))}"
    return document("tagmetry: the laboratory", body, _MORE_STYLE)


def _header(told: Sequence[Chapter]) -> str:
    checks = [check for one in told for check in one.conclusions.checks]
    held = sum(check.holds is True for check in checks)
    judged = sum(check.holds is not None for check in checks)
    entries = "".join(f"<li>{_entry(one)}</li>" for one in told)
    return (
        "<header><h1>The laboratory</h1>"
        f"<p>tagmetry {__version__}: published experiments beside ours. "
        f"{held} of {judged} checks hold.</p><ul>{entries}</ul></header>"
    )


def _entry(one: Chapter) -> str:
    about = one.experiment
    if one.origin is None:
        return f"{escape(about.title)} <em>(not run: tagmetry lab run {about.name})</em>"
    return f"<a href='#{about.name}'>{escape(about.title)}</a> ({escape(about.source)})"


def _section(one: Chapter) -> str:
    about, told = one.experiment, one.conclusions
    return (
        f"<section id='{about.name}'><h2>{escape(about.title)}</h2>"
        f"<p class='note'>{escape(_origin(one))}</p>"
        f"{_checks(told.checks)}{_remarks(told.remarks)}"
        f"{''.join(map(_table, told.tables))}"
        f"<div class='figures'>{''.join(map(figure_html, told.figures))}</div></section>"
    )


def _origin(one: Chapter) -> str:
    origin = one.origin
    if origin is None:
        return ""
    kind = "a quick run" if origin.quick else "a full run"
    return (
        f"{one.experiment.name}: {one.experiment.source}. {kind.capitalize()} of "
        f"{len(origin.settings)} cases, seed {origin.seed}, tagmetry {origin.version}."
    )


def _checks(checks: Sequence[Check]) -> str:
    header = ("what must hold", "required", "measured", "")
    rows = tuple((one.told, one.required, one.measured, verdict(one)) for one in checks)
    return _table(ReportTable("checks", "What must hold", header, rows)) if rows else ""


def _remarks(remarks: Sequence[str]) -> str:
    return f"<h3>To know</h3>{list_html(remarks)}" if remarks else ""


def _table(table: ReportTable) -> str:
    return titled_table_html(table, _class_of)


def _class_of(cell: Cell) -> str:
    """Return a cell's classes: good and bad words have colours."""
    verdict_class = " yes" if cell in _GOOD else " no" if cell in _BAD else ""
    return cell_class(cell) + verdict_class
