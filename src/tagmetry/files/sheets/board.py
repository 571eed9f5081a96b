"""The tile of a board.

Frames: `board` has its origin at the centre, y up; the tile has its origin at the top left, y down.
"""

from tagmetry.errors import InputError
from tagmetry.files.sheets.board_facts import board_facts
from tagmetry.files.sheets.marker import check_printable, marker_cells
from tagmetry.files.sheets.page import Cells, Disc, bar
from tagmetry.files.sheets.tile import Tile, labelled
from tagmetry.markers import Board, family

_MOST_PLACES = 100_000


def board_tile(board: Board, quiet_cells: int = 1, *, inverted: bool = False) -> Tile:
    """Return a board in its quiet zone.

    Args:
        board: One of the boards of `tagmetry.markers`.
        quiet_cells: Width of the white around it, in cells of its markers; a quarter of a square
            counts as a cell of a chessboard, a quarter of a disc as one of a circle grid.
        inverted: Print white on black.

    Raises:
        InputError: The board cannot be printed or would not be read.
    """
    facts = board_facts(board)
    check_printable(facts.size_name, facts.size_m)
    if facts.places > _MOST_PLACES:
        raise InputError(
            f"a board may have up to {_MOST_PLACES} places, got {facts.places}; "
            "print fewer rows or columns"
        )
    quiet_m = quiet_cells * facts.cell_m + facts.reach_m
    return labelled(
        ink=_ink(board, quiet_m),
        width_m=board.width_m + 2 * quiet_m,
        height_m=board.height_m + 2 * quiet_m,
        labels=(facts.title, facts.title.split(",", maxsplit=1)[0]),
        size_name=facts.size_name,
        size_m=facts.size_m,
        inverted=inverted,
    )


def board_title(board: Board) -> str:
    """Return what a board is, in one line."""
    return board_facts(board).title


def _ink(board: Board, quiet_m: float) -> tuple[Cells | Disc, ...]:
    centre_x_m, centre_y_m = quiet_m + board.width_m / 2, quiet_m + board.height_m / 2
    squares = [
        bar(centre_x_m + x_m, centre_y_m - y_m - side_m, side_m, side_m)
        for x_m, y_m, side_m in board.black_squares_m().tolist()
    ]
    markers = []
    for mounted in board.markers():
        x_m, y_m, _ = mounted.corners_m[0]
        left_m, top_m = centre_x_m + x_m, centre_y_m - y_m
        markers.append(
            marker_cells(family(mounted.family), mounted.id, left_m, top_m, mounted.size_m)
        )
    discs = [
        Disc(centre_x_m + x_m, centre_y_m - y_m, radius_m)
        for x_m, y_m, radius_m in board.circles_m().tolist()
    ]
    return (*squares, *markers, *discs)
