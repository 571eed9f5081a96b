"""The tile of a board.

Frames: `board` has its origin at the centre, y up; the tile has its origin at the top left, y down.
"""

from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm
from tagmetry.files.sheets.ids import describe_ids
from tagmetry.files.sheets.marker import cell_m, check_printable, marker_cells
from tagmetry.files.sheets.page import Cells, Disc, bar
from tagmetry.files.sheets.tile import Tile, labelled
from tagmetry.markers import (
    AprilGrid,
    Board,
    CharucoBoard,
    Chessboard,
    CircleGrid,
    GridBoard,
    MarkerFamily,
    family,
)

_MOST_PLACES = 100_000
_CHESSBOARD_QUIET = 0.25  # of a square
_DISC_QUIET = 0.25  # of a diameter


@dataclass(frozen=True)
class _Facts:
    """What printing must know of a board beyond its ink; bits may reach beyond its pattern."""

    title: str
    places: int
    size_name: str
    size_m: float
    cell_m: float
    reach_m: float = 0.0


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
    facts = _facts(board)
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
    return _facts(board).title


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


def _facts(board: Board) -> _Facts:
    match board:
        case GridBoard():
            return _grid_facts(board)
        case AprilGrid():
            return _aprilgrid_facts(board)
        case Chessboard():
            return _chessboard_facts(board)
        case CharucoBoard():
            return _charuco_facts(board)
        case CircleGrid():
            return _circles_facts(board)
    raise InputError(
        "only GridBoard, AprilGrid, Chessboard, CharucoBoard and CircleGrid can be printed, got "
        f"{type(board).__name__}"
    )


def _grid_facts(board: GridBoard) -> _Facts:
    tags = family(board.family)
    places = board.columns * board.rows
    _check_white(tags, board.size_m, board.gap_m, "gap")
    title = (
        f"Grid {board.columns}x{board.rows}, size {format_mm(board.size_m)}, "
        f"gap {format_mm(board.gap_m)}, {_ids(tags, board.first_id, places)}"
    )
    return _marker_facts(title, places, tags, board.size_m)


def _aprilgrid_facts(board: AprilGrid) -> _Facts:
    tags = family(board.family)
    places = board.columns * board.rows
    if tags.layout.margin_cells:
        raise InputError(
            f"an AprilGrid has black squares at its markers' corners, where {tags.name} has bits; "
            "print a grid board instead, or choose a family of black squares such as tag36h11"
        )
    _check_white(tags, board.size_m, board.grid.gap_m, "spacing")
    title = (
        f"AprilGrid {board.columns}x{board.rows}, size {format_mm(board.size_m)}, "
        f"spacing {board.spacing:g}, {_ids(tags, board.first_id, places)}"
    )
    return _marker_facts(title, places, tags, board.size_m)


def _marker_facts(title: str, places: int, tags: MarkerFamily, size_m: float) -> _Facts:
    cell = cell_m(tags, size_m)
    return _Facts(title, places, "size", size_m, cell, tags.layout.margin_cells * cell)


def _chessboard_facts(board: Chessboard) -> _Facts:
    title = (
        f"Chessboard {board.corner_columns}x{board.corner_rows} inner corners, "
        f"square {format_mm(board.square_m)}"
    )
    places = (board.corner_columns + 1) * (board.corner_rows + 1)
    return _Facts(title, places, "square", board.square_m, _CHESSBOARD_QUIET * board.square_m)


def _charuco_facts(board: CharucoBoard) -> _Facts:
    tags = family(board.family)
    white = (board.columns * board.rows + (not board.first_black)) // 2
    title = (
        f"ChArUco {board.columns}x{board.rows}{' legacy' * board.legacy}, "
        f"square {format_mm(board.square_m)}, size {format_mm(board.size_m)}, "
        f"{_ids(tags, board.first_id, white)}"
    )
    places = board.columns * board.rows
    check_printable("size", board.size_m)
    _check_within(tags, board.size_m, board.square_m)
    return _Facts(title, places, "square", board.square_m, cell_m(tags, board.size_m))


def _circles_facts(board: CircleGrid) -> _Facts:
    title = (
        f"{'Asymmetric circles' if board.asymmetric else 'Circles'} {board.columns}x{board.rows}, "
        f"pitch {format_mm(board.pitch_m)}, diameter {format_mm(board.diameter_m)}"
    )
    quiet_cell_m = _DISC_QUIET * board.diameter_m
    return _Facts(title, board.columns * board.rows, "diameter", board.diameter_m, quiet_cell_m)


def _ids(tags: MarkerFamily, first_id: int, count: int) -> str:
    last_id = tags.checked_id(first_id + count - 1)
    return f"{tags.name} {describe_ids(range(tags.checked_id(first_id), last_id + 1))}"


def _check_white(tags: MarkerFamily, size_m: float, gap_m: float, name: str) -> None:
    """Refuse neighbours with less than a cell of white between them: they would not be read."""
    least_m = (1 + 2 * tags.layout.margin_cells) * cell_m(tags, size_m)
    if gap_m < least_m * (1 - 1e-9):
        raise InputError(
            f"the {name} leaves {format_mm(gap_m)} between markers, which need at least one cell, "
            f"{format_mm(least_m)}"
        )


def _check_within(tags: MarkerFamily, size_m: float, square_m: float) -> None:
    """Refuse markers whose outer bits would lie on the black squares around their own."""
    printed_m = size_m + 2 * tags.layout.margin_cells * cell_m(tags, size_m)
    if printed_m > square_m:
        raise InputError(
            f"{tags.name} prints {format_mm(printed_m)} for a size of {format_mm(size_m)}, more "
            f"than a square of {format_mm(square_m)}; the largest size is "
            f"{format_mm(size_m * square_m / printed_m)}"
        )
