"""All panels on one page that needs no other file."""

from collections.abc import Sequence
from html import escape

from tagmetry.record.report.html import document, image_html
from tagmetry.record.stages.panel import Panel, jpeg


def page(groups: Sequence[tuple[str, Sequence[Panel]]]) -> str:
    """Return HTML with titled groups of panels, numbered through."""
    numbers = iter(range(1, 1 + sum(len(panels) for _, panels in groups)))
    sections = [
        f"<section><h2>{escape(title)}</h2>"
        + "".join(_figure(panel, next(numbers)) for panel in panels)
        + "</section>"
        for title, panels in groups
    ]
    header = "<header><h1>Stages of the detector</h1></header>\n"
    return document("Stages of the detector", header + "".join(sections))


def _figure(panel: Panel, number: int) -> str:
    picture = image_html(jpeg(panel.pixels), "jpeg", panel.title)
    return (
        f"<figure><h3>{number}. {escape(panel.title)}</h3>{picture}"
        f"<figcaption>{escape(panel.text)}</figcaption></figure>"
    )
