"""Pages of a marker, of a board, and of many markers."""

from collections.abc import Sequence

from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm
from tagmetry.files.sheets.arrange import arranged
from tagmetry.files.sheets.board import board_tile, board_title
from tagmetry.files.sheets.ids import describe_ids
from tagmetry.files.sheets.marker import marker_tile
from tagmetry.files.sheets.page import Page
from tagmetry.files.sheets.paper import PageSetup
from tagmetry.markers import Board, MarkerFamily

_A4 = PageSetup()


def marker_page(
    family: MarkerFamily, marker_id: int, size_m: float, setup: PageSetup = _A4
) -> Page:
    """Return a page with one marker.

    Args:
        family: Its family.
        marker_id: Its id.
        size_m: Side of its black square.
        setup: Paper, margins and so on.

    Raises:
        InputError: There is no such marker, or it does not fit.
    """
    return sheet_pages(family, [marker_id], size_m, setup)[0]


def sheet_pages(
    family: MarkerFamily, ids: Sequence[int], size_m: float, setup: PageSetup = _A4
) -> tuple[Page, ...]:
    """Return pages with many markers of one size to cut out.

    Args:
        family: Their family.
        ids: Their ids, in the order of reading.
        size_m: Side of their black squares.
        setup: Paper, margins and so on.

    Raises:
        InputError: There are no such markers, or not even one fits a page.
    """
    if not ids:
        raise InputError("a sheet needs at least one id, got none")
    tiles = [
        marker_tile(family, marker_id, size_m, setup.quiet_cells, inverted=setup.inverted)
        for marker_id in ids
    ]
    caption = f"{family.name}, {describe_ids(ids)}, {format_mm(size_m)}"
    return arranged(tiles, caption, setup)


def board_page(board: Board, setup: PageSetup = _A4) -> Page:
    """Return a page with one board.

    Args:
        board: One of the boards of `tagmetry.markers`.
        setup: Paper, margins and so on.

    Raises:
        InputError: The board cannot be printed, or does not fit.
    """
    tile = board_tile(board, setup.quiet_cells, inverted=setup.inverted)
    return arranged([tile], board_title(board), setup)[0]
