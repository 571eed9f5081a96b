"""Boards in one line, as people type them: `chessboard:9x6:25mm`."""

import re
from collections.abc import Callable, Sequence

from tagmetry.errors import InputError
from tagmetry.files.lengths import parse_length_m
from tagmetry.files.text import named_errors
from tagmetry.markers import (
    AprilGrid,
    Board,
    CharucoBoard,
    Chessboard,
    CircleGrid,
    GridBoard,
    family,
)

_FORMS = {
    "chessboard": "chessboard:COLUMNSxROWS:SQUARE (inner corners, e.g. chessboard:9x6:25mm)",
    "charuco": "charuco:COLUMNSxROWS:SQUARE:MARKER:FAMILY[:ID][:legacy] (squares, "
    "e.g. charuco:7x5:30mm:22mm:5x5_100)",
    "circles": "circles:COLUMNSxROWS:PITCH:DIAMETER (e.g. circles:7x5:30mm:15mm)",
    "asymmetric-circles": "asymmetric-circles:COLUMNSxROWS:PITCH:DIAMETER (pitch from row to row, "
    "e.g. asymmetric-circles:4x11:20mm:15mm)",
    "aprilgrid": "aprilgrid:COLUMNSxROWS:SIZE:SPACING[:FAMILY][:ID] (spacing a share of the size "
    "or a length, e.g. aprilgrid:6x6:88mm:0.3)",
    "grid": "grid:COLUMNSxROWS:SIZE:GAP:FAMILY[:ID][:from-bottom] "
    "(markers, e.g. grid:4x5:37.5mm:5mm:6x6_250)",
}
_COUNTS = re.compile(r"(?P<columns>\d{1,4})\s*[xX]\s*(?P<rows>\d{1,4})", re.ASCII)
_ID = re.compile(r"\d{1,6}", re.ASCII)
_RATIO = re.compile(r"(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
_MOST_PER_SIDE = 200
_LONGEST = 200


def parse_board(text: str) -> Board:
    """Return the board that a line describes.

    Args:
        text: `chessboard:9x6:25mm` and so on; lengths in metres, or with mm, cm, m or in.

    Raises:
        InputError: The line describes no board; the text gives the form expected.
    """
    kind, *fields = [field.strip() for field in text[:_LONGEST].split(":")]
    if kind not in _FORMS:
        raise InputError(
            f"expected a board as {', '.join(f'{name}:…' for name in _FORMS)}, found "
            f"{_shown(text)}; for example chessboard:9x6:25mm, with 9x6 inner corners"
        )
    with named_errors(f"board {_shown(text)}"):
        return _READERS[kind](kind, fields)


def board_text(board: Board) -> str:
    """Return the line that describes a board; `parse_board` gives an equal one.

    Raises:
        InputError: It is none of the boards of `tagmetry.markers`.
    """
    match board:
        case Chessboard():
            counts = f"{board.corner_columns}x{board.corner_rows}"
            return f"chessboard:{counts}:{_length_text(board.square_m)}"
        case CharucoBoard():
            return _charuco_text(board)
        case CircleGrid():
            kind = "asymmetric-circles" if board.asymmetric else "circles"
            lengths = (board.pitch_m, board.diameter_m)
            return _joined(kind, board.columns, board.rows, *map(_length_text, lengths))
        case AprilGrid():
            lengths_text = (_length_text(board.size_m), repr(float(board.spacing)))
            tags = (board.family, *_id_text(board.first_id))
            return _joined("aprilgrid", board.columns, board.rows, *lengths_text, *tags)
        case GridBoard():
            return _grid_text(board)
    raise InputError(f"a board of type {type(board).__name__} has no text form")


def _chessboard(kind: str, fields: Sequence[str]) -> Board:
    _check_count(kind, fields, 2, 2)
    return Chessboard(*_counts(kind, fields), parse_length_m(fields[1]))


def _charuco(kind: str, fields: Sequence[str]) -> Board:
    _check_count(kind, fields, 4, 6)
    first_id, legacy = _tail(kind, fields[4:], "legacy")
    lengths_m = (parse_length_m(fields[1]), parse_length_m(fields[2]))
    return CharucoBoard(*_counts(kind, fields), *lengths_m, _family(fields[3]), first_id, legacy)


def _circles(kind: str, fields: Sequence[str]) -> Board:
    _check_count(kind, fields, 3, 3)
    lengths_m = (parse_length_m(fields[1]), parse_length_m(fields[2]))
    return CircleGrid(*_counts(kind, fields), *lengths_m, asymmetric=kind != "circles")


def _aprilgrid(kind: str, fields: Sequence[str]) -> Board:
    _check_count(kind, fields, 3, 5)
    size_m, spacing = parse_length_m(fields[1]), fields[2]
    ratio = float(spacing) if _RATIO.fullmatch(spacing) else parse_length_m(spacing) / size_m
    tags = _family(fields[3]) if len(fields) > 3 else "tag36h11_border2"
    first_id, _ = _tail(kind, fields[4:])
    return AprilGrid(*_counts(kind, fields), size_m, ratio, tags, first_id)


def _grid(kind: str, fields: Sequence[str]) -> Board:
    _check_count(kind, fields, 4, 6)
    first_id, from_bottom = _tail(kind, fields[4:], "from-bottom")
    lengths_m = (parse_length_m(fields[1]), parse_length_m(fields[2]))
    return GridBoard(*_counts(kind, fields), *lengths_m, _family(fields[3]), first_id, from_bottom)


_READERS: dict[str, Callable[[str, Sequence[str]], Board]] = {
    "chessboard": _chessboard,
    "charuco": _charuco,
    "circles": _circles,
    "asymmetric-circles": _circles,
    "aprilgrid": _aprilgrid,
    "grid": _grid,
}


def _check_count(kind: str, fields: Sequence[str], least: int, most: int) -> None:
    if not least <= len(fields) <= most:
        raise InputError(f"expected {_FORMS[kind]}, found {len(fields)} parts after {kind}")


def _counts(kind: str, fields: Sequence[str]) -> tuple[int, int]:
    match = _COUNTS.fullmatch(fields[0])
    if match is None:
        raise InputError(f"expected COLUMNSxROWS like 9x6 in {_FORMS[kind]}, found {fields[0]!r}")
    columns, rows = int(match["columns"]), int(match["rows"])
    if max(columns, rows) > _MOST_PER_SIDE:
        raise InputError(f"a board has at most {_MOST_PER_SIDE} columns or rows, found {fields[0]}")
    return columns, rows


def _family(name: str) -> str:
    """Return the name of a predefined family as `family` spells it."""
    return family(name).name


def _tail(kind: str, fields: Sequence[str], flag: str = "") -> tuple[int, bool]:
    """Return the first id, 0 when none is given, and whether the flag stands at the end."""
    rest = list(fields)
    flagged = bool(flag) and rest[-1:] == [flag]
    if flagged:
        rest.pop()
    first_id = int(rest.pop()) if rest and _ID.fullmatch(rest[-1]) else 0
    if rest:
        raise InputError(f"expected {_FORMS[kind]}, found {rest[0]!r}")
    return first_id, flagged


def _charuco_text(board: CharucoBoard) -> str:
    lengths = (_length_text(board.square_m), _length_text(board.size_m))
    tail = (*_id_text(board.first_id), *(["legacy"] if board.legacy else []))
    return _joined("charuco", board.columns, board.rows, *lengths, board.family, *tail)


def _grid_text(board: GridBoard) -> str:
    lengths = (_length_text(board.size_m), _length_text(board.gap_m))
    tail = (*_id_text(board.first_id), *(["from-bottom"] if board.from_bottom else []))
    return _joined("grid", board.columns, board.rows, *lengths, board.family, *tail)


def _joined(kind: str, columns: int, rows: int, *fields: str) -> str:
    return ":".join([kind, f"{columns}x{rows}", *fields])


def _id_text(first_id: int) -> list[str]:
    return [str(first_id)] if first_id else []


def _length_text(length_m: float) -> str:
    """Return millimetres where they say it exactly, else metres."""
    text = f"{1000 * length_m:.7g}mm"
    return text if parse_length_m(text) == length_m else repr(float(length_m))


def _shown(text: str) -> str:
    return repr(text if len(text) <= 60 else text[:60] + "…")
