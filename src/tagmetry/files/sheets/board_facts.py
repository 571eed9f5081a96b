"""What printing must know of each kind of board: its name, its size, whether it will be read."""

from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm
from tagmetry.files.sheets.ids import describe_ids
from tagmetry.files.sheets.marker import cell_m, check_printable
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

_CHESSBOARD_QUIET = 0.25  # of a square
_DISC_QUIET = 0.25  # of a diameter


@dataclass(frozen=True)
class BoardFacts:
    """What printing must know of a board beyond its ink.

    Attributes:
        title: What it is, in one line.
        places: Of squares, markers or discs.
        size_name: What its maker calls the size that it is printed by.
        size_m: That size.
        cell_m: Side of a cell, by which the quiet zone is counted.
        reach_m: How far bits reach beyond its pattern.
    """

    title: str
    places: int
    size_name: str
    size_m: float
    cell_m: float
    reach_m: float = 0.0


def board_facts(board: Board) -> BoardFacts:
    """Return what printing must know of a board.

    Raises:
        InputError: The board cannot be printed or would not be read.
    """
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


def _grid_facts(board: GridBoard) -> BoardFacts:
    tags = family(board.family)
    places = board.columns * board.rows
    _check_white(tags, board.size_m, board.gap_m, "gap")
    title = (
        f"Grid {board.columns}x{board.rows}, size {format_mm(board.size_m)}, "
        f"gap {format_mm(board.gap_m)}, {_ids(tags, board.first_id, places)}"
    )
    return _marker_facts(title, places, tags, board.size_m)


def _aprilgrid_facts(board: AprilGrid) -> BoardFacts:
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


def _marker_facts(title: str, places: int, tags: MarkerFamily, size_m: float) -> BoardFacts:
    cell = cell_m(tags, size_m)
    return BoardFacts(title, places, "size", size_m, cell, tags.layout.margin_cells * cell)


def _chessboard_facts(board: Chessboard) -> BoardFacts:
    title = (
        f"Chessboard {board.corner_columns}x{board.corner_rows} inner corners, "
        f"square {format_mm(board.square_m)}"
    )
    places = (board.corner_columns + 1) * (board.corner_rows + 1)
    return BoardFacts(title, places, "square", board.square_m, _CHESSBOARD_QUIET * board.square_m)


def _charuco_facts(board: CharucoBoard) -> BoardFacts:
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
    return BoardFacts(title, places, "square", board.square_m, cell_m(tags, board.size_m))


def _circles_facts(board: CircleGrid) -> BoardFacts:
    title = (
        f"{'Asymmetric circles' if board.asymmetric else 'Circles'} {board.columns}x{board.rows}, "
        f"pitch {format_mm(board.pitch_m)}, diameter {format_mm(board.diameter_m)}"
    )
    quiet_cell_m = _DISC_QUIET * board.diameter_m
    return BoardFacts(title, board.columns * board.rows, "diameter", board.diameter_m, quiet_cell_m)


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
