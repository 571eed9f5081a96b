"""Reports as HTML: no script, nothing from elsewhere, readable in light and dark."""

import base64
from collections.abc import Callable, Sequence
from html import escape
from math import isfinite

from tagmetry.record.report.figure import ReportFigure
from tagmetry.record.report.plot import svg
from tagmetry.record.report.style import STYLE
from tagmetry.record.report.table import Cell, ReportTable


def document(title: str, body: str, more_style: str = "") -> str:
    """Return a whole page.

    Args:
        title: Of the window.
        body: HTML.
        more_style: CSS after that of all reports.
    """
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}{more_style}</style>\n</head>\n"
        f"<body>\n<main>\n{body}\n</main>\n</body>\n</html>\n"
    )


def cell_class(cell: Cell) -> str:
    """Return a cell's class in the style: `text`, or none for a number."""
    return "text" if isinstance(cell, str) else ""


def table_html(table: ReportTable, class_of: Callable[[Cell], str] = cell_class) -> str:
    """Return a table, or `None.` where it has no rows.

    Args:
        table: Numbers in full; five or so digits are shown.
        class_of: A cell's classes in the style.
    """
    if not table.rows:
        return "<p>None.</p>"
    head = "".join(f"<th scope='col'>{escape(name)}</th>" for name in table.header)
    rows = "".join(
        f"<tr>{''.join(_cell(cell, class_of(cell)) for cell in row)}</tr>" for row in table.rows
    )
    whole = f"<thead><tr>{head}</tr></thead><tbody>{rows}</tbody>"
    return f"<div class='wide'><table>{whole}</table></div>"


def titled_table_html(table: ReportTable, class_of: Callable[[Cell], str] = cell_class) -> str:
    """Return a table under its title."""
    return f"<h3>{escape(table.title)}</h3>{table_html(table, class_of)}"


def figure_html(figure: ReportFigure) -> str:
    """Return a figure, drawn, above its text.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    drawn = image_html(svg(figure.draw()), "svg+xml", f"{figure.title}. {figure.told}")
    return (
        f"<figure id='{figure.name}'>{drawn}"
        f"<figcaption><strong>{escape(figure.title)}.</strong> {escape(figure.told)}</figcaption>"
        "</figure>"
    )


def image_html(content: bytes, kind: str, told: str) -> str:
    """Return a picture that stands in the page itself.

    Args:
        content: The file's bytes.
        kind: Its type: `svg+xml`, `jpeg`.
        told: What it shows, for those who do not see it.
    """
    encoded = base64.b64encode(content).decode("ascii")
    return f'<img src="data:image/{kind};base64,{encoded}" alt="{escape(told, quote=True)}">'


def list_html(entries: Sequence[str]) -> str:
    """Return entries, one below the other."""
    return f"<ul>{''.join(f'<li>{escape(entry)}</li>' for entry in entries)}</ul>"


def _cell(cell: Cell, classes: str) -> str:
    named = f" class='{classes}'" if classes else ""
    return f"<td{named}>{escape(_shown(cell))}</td>"


def _shown(cell: Cell) -> str:
    """Return a cell for people: five or so digits."""
    if not isinstance(cell, float):
        return str(cell)
    if not isfinite(cell):
        return "-"
    return f"{cell:.5g}" if abs(cell) < 1000 else f"{cell:.1f}"
