"""The report as one page: no script, nothing from elsewhere, readable in light and dark."""

import base64
from collections.abc import Iterator, Sequence
from html import escape

import numpy as np

from tagmetry import __version__
from tagmetry.lab.conclusions import Check
from tagmetry.lab.report.chapter import Chapter
from tagmetry.lab.report.text import verdict
from tagmetry.record.calibration_report.drawing import svg
from tagmetry.record.calibration_report.figures import ReportFigure
from tagmetry.record.calibration_report.style import STYLE
from tagmetry.record.calibration_report.tables import Cell, ReportTable

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
    return (
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>"
        "<meta name='viewport' content='width=device-width, initial-scale=1'>"
        f"<title>tagmetry: the laboratory</title><style>{STYLE}{_MORE_STYLE}</style></head>"
        f"<body><main>{_header(told)}{''.join(map(_section, run))}</main></body></html>\n"
    )


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
        f"<div class='figures'>{''.join(map(_figure, told.figures))}</div></section>"
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
    entries = "".join(f"<li>{escape(one)}</li>" for one in remarks)
    return f"<h3>To know</h3><ul>{entries}</ul>" if remarks else ""


def _table(table: ReportTable) -> str:
    head = "".join(f"<th scope='col'>{escape(name)}</th>" for name in table.header)
    rows = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in table.rows)
    return (
        f"<h3>{escape(table.title)}</h3><div class='wide'><table><thead><tr>{head}</tr></thead>"
        f"<tbody>{rows}</tbody></table></div>"
    )


def _cell(cell: Cell) -> str:
    return f"<td{''.join(_kinds(cell))}>{escape(_shown(cell))}</td>"


def _kinds(cell: Cell) -> Iterator[str]:
    if isinstance(cell, str):
        kind = " yes" if cell in _GOOD else " no" if cell in _BAD else ""
        yield f" class='text{kind}'"


def _shown(cell: Cell) -> str:
    """Return a cell for people: five or so digits."""
    if not isinstance(cell, float):
        return str(cell)
    if not np.isfinite(cell):
        return "-"
    return f"{cell:.5g}" if abs(cell) < 1000 else f"{cell:.1f}"


def _figure(figure: ReportFigure) -> str:
    encoded = base64.b64encode(svg(figure.draw())).decode("ascii")
    told = escape(f"{figure.title}. {figure.told}", quote=True)
    return (
        f"<figure id='{figure.name}'><img src='data:image/svg+xml;base64,{encoded}' alt='{told}'>"
        f"<figcaption><strong>{escape(figure.title)}.</strong> {escape(figure.told)}</figcaption>"
        "</figure>"
    )
