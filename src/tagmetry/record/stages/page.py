"""All panels on one page that needs no other file."""

import base64
from collections.abc import Sequence
from html import escape

from tagmetry.record.calibration_report.style import STYLE
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
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>Stages of the detector</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n"
        f"<header><h1>Stages of the detector</h1></header>\n{''.join(sections)}\n</main>\n</body>\n"
        "</html>\n"
    )


def _figure(panel: Panel, number: int) -> str:
    source = base64.b64encode(jpeg(panel.pixels)).decode()
    return (
        f"<figure><h3>{number}. {escape(panel.title)}</h3>"
        f'<img alt="{escape(panel.title)}" src="data:image/jpeg;base64,{source}">'
        f"<figcaption>{escape(panel.text)}</figcaption></figure>"
    )
