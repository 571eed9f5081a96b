"""What can be printed: the fields that each kind asks for, and the pages that they make.

A new kind is one function and one line in `KINDS`; the page builds its form from there.
"""

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType

from tagmetry.errors import InputError
from tagmetry.files.sheets import Page, board_page, parse_ids, sheet_pages
from tagmetry.live.rooms.printing.wishes import MOST_PLACES, Wishes
from tagmetry.markers import (
    AprilGrid,
    CharucoBoard,
    Chessboard,
    CircleGrid,
    GridBoard,
    family,
)

_LAST_ID = 10**6


@dataclass(frozen=True)
class Kind:
    """A kind of print.

    Attributes:
        label: As people call it.
        usual: Its fields with what they hold at first.
        pages: Makes the pages.
    """

    label: str
    usual: dict[str, str]
    pages: Callable[[Wishes], tuple[Page, ...]]


def _sheet(wishes: Wishes) -> tuple[Page, ...]:
    markers = family(wishes.text("family"))
    ids = parse_ids(wishes.text("ids"), markers)
    if len(ids) > MOST_PLACES:
        raise InputError(
            f"ids: the page prints up to {MOST_PLACES} markers at once, got {len(ids)}; "
            "`tagmetry print sheet` prints any number"
        )
    return sheet_pages(markers, ids, wishes.length_m("size"), wishes.setup())


def _chessboard(wishes: Wishes) -> tuple[Page, ...]:
    board = Chessboard(*_counts(wishes, least=2), wishes.length_m("square"))
    return (board_page(board, wishes.setup()),)


def _charuco(wishes: Wishes) -> tuple[Page, ...]:
    board = CharucoBoard(
        *_counts(wishes, least=2),
        wishes.length_m("square"),
        wishes.length_m("size"),
        wishes.text("family"),
        _first_id(wishes),
    )
    return (board_page(board, wishes.setup()),)


def _grid(wishes: Wishes) -> tuple[Page, ...]:
    board = GridBoard(
        *_counts(wishes),
        wishes.length_m("size"),
        wishes.length_m("gap"),
        wishes.text("family"),
        _first_id(wishes),
    )
    return (board_page(board, wishes.setup()),)


def _aprilgrid(wishes: Wishes) -> tuple[Page, ...]:
    size_m = wishes.length_m("size")
    spacing = wishes.length_m("gap") / size_m
    board = AprilGrid(
        *_counts(wishes), size_m, spacing, f"{wishes.text('family')}_border2", _first_id(wishes)
    )
    return (board_page(board, wishes.setup()),)


def _circles(wishes: Wishes) -> tuple[Page, ...]:
    board = CircleGrid(
        *_counts(wishes, least=2), wishes.length_m("pitch"), wishes.length_m("diameter")
    )
    return (board_page(board, wishes.setup()),)


def _counts(wishes: Wishes, least: int = 1) -> tuple[int, int]:
    """Return columns and rows of a board that is drawn in a second or two."""
    columns, rows = wishes.count("columns", least=least), wishes.count("rows", least=least)
    if columns * rows > MOST_PLACES:
        raise InputError(
            f"columns, rows: the page prints up to {MOST_PLACES} places, got {columns * rows}; "
            "`tagmetry print board` prints more"
        )
    return columns, rows


def _first_id(wishes: Wishes) -> int:
    return wishes.count("first_id", _LAST_ID, least=0)


_BOARD = {"columns": "7", "rows": "5", "first_id": "0"}
KINDS = MappingProxyType(
    {
        "sheet": Kind(
            "Markers to cut out",
            {"family": "tag36h11", "ids": "0-11", "size": "40mm"},
            _sheet,
        ),
        "charuco": Kind(
            "ChArUco board",
            {"family": "5x5_100", **_BOARD, "square": "30mm", "size": "22mm"},
            _charuco,
        ),
        "chessboard": Kind(
            "Chessboard, by its inner corners",
            {"columns": "9", "rows": "6", "square": "20mm"},
            _chessboard,
        ),
        "grid": Kind(
            "Grid of markers",
            {"family": "tag36h11", **_BOARD, "size": "25mm", "gap": "8mm"},
            _grid,
        ),
        "aprilgrid": Kind(
            "AprilGrid, as Kalibr wants it",
            {"family": "tag36h11", **_BOARD, "size": "22mm", "gap": "6.6mm"},
            _aprilgrid,
        ),
        "circles": Kind(
            "Discs",
            {"columns": "9", "rows": "6", "pitch": "20mm", "diameter": "12mm"},
            _circles,
        ),
    }
)


def pages_of(kind: str, wishes: Wishes) -> tuple[Page, ...]:
    """Return what is printed.

    Args:
        kind: One of `KINDS`.
        wishes: Its fields, and those of the paper.

    Raises:
        InputError: There is no such kind, or a field cannot be used.
    """
    if kind not in KINDS:
        raise InputError(f"expected one of {', '.join(KINDS)}, found {kind[:40]!r}")
    return KINDS[kind].pages(wishes)
