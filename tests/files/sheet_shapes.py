"""What stands on a page: its boxes, its ruler, its markers."""

from itertools import combinations

from tagmetry.files.sheets import Page
from tagmetry.files.sheets.page import Box, Cells, Text
from tagmetry.markers import family

TAG = family("tag36h11")
TINY_M = 1e-9


def boxes(page: Page) -> list[Box]:
    """Everything on the page; the bars of the ruler touch, so they count as one."""
    loose = [shape.box for shape in page.shapes if not in_ruler(page, shape)]
    return [*loose, ruler_box(page)]


def ruler_bars(page: Page) -> list[Box]:
    """The ruler's line and ticks: the bars between the last block of cells and the last text."""
    bars = [shape.box for shape in page.shapes if isinstance(shape, Cells)]
    line = max(i for i, box in enumerate(bars) if box.height_m < 0.0003 < box.width_m - 0.005)
    return bars[line:]


def ruler_box(page: Page) -> Box:
    bars = ruler_bars(page)
    left, top = min(b.x_m for b in bars), min(b.y_m for b in bars)
    right, bottom = max(b.right_m for b in bars), max(b.bottom_m for b in bars)
    return Box(left, top, right - left, bottom - top)


def in_ruler(page: Page, shape: Cells | Text) -> bool:
    return isinstance(shape, Cells) and shape.box in ruler_bars(page)


def overlap(a: Box, b: Box) -> bool:
    across = min(a.right_m, b.right_m) - max(a.x_m, b.x_m)
    down = min(a.bottom_m, b.bottom_m) - max(a.y_m, b.y_m)
    return across > TINY_M and down > TINY_M


def assert_tidy(page: Page, margin_m: float) -> None:
    for box in boxes(page):
        assert box.x_m >= margin_m - TINY_M
        assert box.y_m >= margin_m - TINY_M
        assert box.right_m <= page.width_m - margin_m + TINY_M
        assert box.bottom_m <= page.height_m - margin_m + TINY_M
    assert not [pair for pair in combinations(boxes(page), 2) if overlap(*pair)]


def markers(page: Page) -> list[Cells]:
    return [s for s in page.shapes if isinstance(s, Cells) and s.filled.size > 1]
