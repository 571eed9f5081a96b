"""Pages as PDF: vectors at true scale, the same bytes for the same pages."""

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING

from tagmetry.errors import MissingExtraError
from tagmetry.files.sheets.outline import outlines_m
from tagmetry.files.sheets.page import Cells, Disc, Ink, Page, Shape, Text

if TYPE_CHECKING:
    from reportlab.pdfgen.canvas import Canvas

_POINTS_PER_M = 72 / 0.0254


def pages_as_pdf(pages: Sequence[Page]) -> bytes:
    """Return the pages as one PDF file; viewers are asked not to scale it when printing.

    Raises:
        MissingExtraError: reportlab is not installed.
    """
    try:
        from reportlab.pdfgen.canvas import Canvas
    except ImportError as error:
        raise MissingExtraError("writing PDF", "print") from error
    file = io.BytesIO()
    canvas = Canvas(file, invariant=True, pageCompression=True)
    canvas.setTitle(pages[0].title)
    canvas.setCreator("tagmetry")
    canvas.setViewerPreference("PrintScaling", "None")
    for page in pages:
        _draw_page(canvas, page)
    canvas.save()
    return file.getvalue()


def _draw_page(canvas: "Canvas", page: Page) -> None:
    width_points, height_points = page.width_m * _POINTS_PER_M, page.height_m * _POINTS_PER_M
    canvas.setPageSize((width_points, height_points))
    for shape in page.shapes:
        _draw(canvas, shape, height_points)
    canvas.showPage()


def _draw(canvas: "Canvas", shape: Shape, height_points: float) -> None:
    """Draw a shape; PDF's y goes up from the bottom."""
    if isinstance(shape, Cells):
        _draw_cells(canvas, shape, height_points)
    elif isinstance(shape, Disc):
        _draw_disc(canvas, shape, height_points)
    else:
        _draw_text(canvas, shape, height_points)


def _draw_text(canvas: "Canvas", text: Text, height_points: float) -> None:
    canvas.setFillGray(0)
    canvas.setFont("Helvetica", text.size_m * _POINTS_PER_M)
    x, y = text.x_m * _POINTS_PER_M, height_points - text.baseline_m * _POINTS_PER_M
    draw = canvas.drawString if text.anchor == "start" else canvas.drawCentredString
    draw(x, y, text.shown)


def _draw_disc(canvas: "Canvas", disc: Disc, height_points: float) -> None:
    canvas.setFillGray(_grey(disc.ink))
    x, y = disc.x_m * _POINTS_PER_M, height_points - disc.y_m * _POINTS_PER_M
    canvas.circle(x, y, disc.radius_m * _POINTS_PER_M, stroke=0, fill=1)


def _grey(ink: Ink) -> int:
    return 0 if ink == "black" else 1


def _draw_cells(canvas: "Canvas", cells: Cells, height_points: float) -> None:
    path = canvas.beginPath()
    for loop_m in outlines_m(cells):
        (first_x, first_y), *others = (loop_m * _POINTS_PER_M).tolist()
        path.moveTo(first_x, height_points - first_y)
        for x, y in others:
            path.lineTo(x, height_points - y)
        path.close()
    canvas.setFillGray(_grey(cells.ink))
    canvas.drawPath(path, stroke=0, fill=1, fillMode=0)  # 0: even-odd
