"""Boards of markers as arrangements and back, and in words."""

from dataclasses import dataclass, replace

from tagmetry.calibrate.doctor.arrangement import Arrangement, Fitting
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, CircleGrid, GridBoard

MarkedBoard = CharucoBoard | GridBoard | AprilGrid

_LARGEST = 0.999  # side of a marker that leaves some white around it, in steps


@dataclass(frozen=True)
class Step:
    """How far a board's places are apart.

    Attributes:
        step_m: From one place to the next.
        side: Of a marker, as a share of the step.
    """

    step_m: float
    side: float


def side_in_steps(board: MarkedBoard) -> Step:
    """Return a board's step and the side of its markers."""
    match board:
        case CharucoBoard():
            step_m = board.square_m
        case GridBoard():
            step_m = board.size_m + board.gap_m
        case AprilGrid():
            step_m = board.size_m * (1 + board.spacing)
    return Step(step_m, board.size_m / step_m)


def arrangement_of(board: MarkedBoard) -> Arrangement:
    """Return which place each id has on a board."""
    match board:
        case CharucoBoard():
            return Arrangement("charuco", board.columns, board.first_id, not board.first_black)
        case GridBoard():
            return Arrangement("grid", board.columns, board.first_id, board.from_bottom)
        case AprilGrid():
            return Arrangement("grid", board.columns, board.first_id, flag=True)


def board_as(
    found: Fitting,
    family: str,
    rows: int,
    step_m: float,
    asked: MarkedBoard | None = None,
    side: float | None = None,
) -> MarkedBoard:
    """Return the board that an arrangement is, its markers of the size asked for where that may be.

    Args:
        found: The arrangement, and how large its markers are.
        family: Of the markers.
        rows: How many rows it has.
        step_m: From one place to the next.
        asked: The board asked for, whose kind of grid and size are kept.
        side: Of a marker in steps; by default as asked for, or as found where nothing was.
    """
    arranged = found.arrangement
    if side is None:
        side = side_in_steps(asked).side if asked is not None else found.side
    columns, first_id = arranged.columns, arranged.first_id
    size_m = round(min(side, _LARGEST) * step_m, 5)
    if arranged.kind == "charuco":
        legacy = arranged.flag and rows % 2 == 0
        return CharucoBoard(columns, rows, step_m, size_m, family, first_id, legacy)
    is_april = "border2" in family if asked is None else isinstance(asked, AprilGrid)
    if is_april and arranged.flag:
        return AprilGrid(columns, rows, size_m, round(1 / side - 1, 3), family, first_id)
    gap_m = round(step_m - size_m, 5)
    return GridBoard(columns, rows, size_m, gap_m, family, first_id, arranged.flag)


def as_asked(board: MarkedBoard, family: str) -> MarkedBoard:
    """Return the board with markers of another family."""
    return replace(board, family=family)


def differences(asked: MarkedBoard, found: MarkedBoard) -> list[str]:
    """Return what is different, in a few words each."""
    kinds = [] if type(asked) is type(found) else ["another kind of board"]
    same = (asked.columns, asked.rows) == (found.columns, found.rows)
    counts = [] if same else [_counts(asked, found)]
    ids = [] if asked.first_id == found.first_id else [f"ids from {found.first_id}"]
    return [*kinds, *counts, *_layouts(asked, found), *ids]


def _layouts(asked: MarkedBoard, found: MarkedBoard) -> list[str]:
    match asked, found:
        case CharucoBoard(), CharucoBoard() if found.legacy and not asked.legacy:
            return ["legacy layout"]
        case CharucoBoard(), CharucoBoard() if asked.legacy and found.first_black:
            return ["not the legacy layout"] if found.rows % 2 == 0 else []
        case GridBoard(), GridBoard() if asked.from_bottom != found.from_bottom:
            return ["rows counted from the other side"]
    return []


def _counts(asked: MarkedBoard, found: MarkedBoard) -> str:
    if (asked.columns, asked.rows) == (found.rows, found.columns):
        return "columns and rows swapped"
    if (asked.columns + 1, asked.rows + 1) == (found.columns, found.rows):
        return "inner corners counted instead of squares"
    if (asked.columns - 1, asked.rows - 1) == (found.columns, found.rows):
        return "one too many in both directions"
    return "other numbers of columns and rows"


def told(board: Board) -> str:
    """Return a board in words: `ChArUco of 7x5 squares`."""
    match board:
        case Chessboard():
            return f"chessboard of {board.corner_columns}x{board.corner_rows} inner corners"
        case CharucoBoard():
            layout = ", legacy layout" if board.legacy else ""
            return f"ChArUco of {board.columns}x{board.rows} squares{_from(board)}{layout}"
        case AprilGrid():
            return f"AprilGrid of {board.columns}x{board.rows} tags{_from(board)}"
        case GridBoard():
            order = ", rows going up" if board.from_bottom else ""
            return f"grid of {board.columns}x{board.rows} markers{_from(board)}{order}"
        case CircleGrid():
            return f"grid of {board.columns}x{board.rows} discs"
    return type(board).__name__


def _from(board: MarkedBoard) -> str:
    return f" with ids from {board.first_id}"
