"""Pages as SVG: one drawing a page, in millimetres."""

from xml.sax.saxutils import escape

from tagmetry.files.sheets.outline import outlines_m
from tagmetry.files.sheets.page import Cells, Disc, Page, Shape, Text
from tagmetry.geometry import Array

_NAMESPACE = 'xmlns="http://www.w3.org/2000/svg"'


def page_as_svg(page: Page) -> str:
    """Return a page as an SVG drawing at true scale; one user unit is a millimetre."""
    width, height = _mm(page.width_m), _mm(page.height_m)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg {_NAMESPACE} width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">',
        f"<title>{escape(page.title)}</title>",
        f'<rect width="{width}" height="{height}" fill="white"/>',
        *(_element(shape) for shape in page.shapes),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _element(shape: Shape) -> str:
    if isinstance(shape, Cells):
        path = "".join(_loop(loop_m) for loop_m in outlines_m(shape))
        return f'<path fill="{shape.ink}" fill-rule="evenodd" d="{path}"/>'
    if isinstance(shape, Disc):
        place = f'cx="{_mm(shape.x_m)}" cy="{_mm(shape.y_m)}" r="{_mm(shape.radius_m)}"'
        return f'<circle fill="{shape.ink}" {place}/>'
    return _text(shape)


def _text(text: Text) -> str:
    return (
        f'<text x="{_mm(text.x_m)}" y="{_mm(text.baseline_m)}" font-size="{_mm(text.size_m)}" '
        f'text-anchor="{text.anchor}" font-family="Helvetica, Arial, sans-serif">'
        f"{escape(text.shown)}</text>"
    )


def _loop(points_m: Array) -> str:
    return "M" + "L".join(f"{_mm(x_m)},{_mm(y_m)}" for x_m, y_m in points_m.tolist()) + "Z"


def _mm(length_m: float) -> str:
    """Return millimetres to the nanometre, without trailing zeros."""
    return f"{1000 * length_m:.6f}".rstrip("0").rstrip(".")
