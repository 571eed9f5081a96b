"""Is the grid of circles the one that was asked for? Others near to it are tried."""

from collections.abc import Sequence
from dataclasses import replace

from tagmetry.calibrate.doctor.advice import BoardAdvice
from tagmetry.calibrate.doctor.marked import seen_instead
from tagmetry.calibrate.targets.circles import find_circles
from tagmetry.calibrate.targets.found import Found
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import CircleGrid

_MOST = 0.5  # share of the pictures
_LEAST = 3  # discs on a side of a grid that is tried


def check_circles(greys: Sequence[GreyPixels], board: CircleGrid) -> list[BoardAdvice]:
    """Return which other grid most pictures show; nothing where they show the one asked for."""
    if _count(greys, board) >= _MOST * len(greys):
        return []
    counted = [(one, _count(greys, one)) for one in _others(board)]
    best, count = max(counted, key=lambda pair: pair[1])
    if count < _MOST * len(greys):
        return seen_instead(greys, board)
    found = f"{_text(best)} in {count} of {len(greys)} pictures"
    return [BoardAdvice("problem", "another grid of circles", _text(board), found, board=best)]


def _count(greys: Sequence[GreyPixels], board: CircleGrid) -> int:
    return sum(isinstance(find_circles(grey, board), Found) for grey in greys)


def _others(board: CircleGrid) -> list[CircleGrid]:
    """Return grids near to the one asked for: turned, one more or fewer, larger ones first."""
    columns, rows = board.columns, board.rows
    sizes = [(rows, columns)]
    steps = [(a, b) for a in (1, 0, -1) for b in (1, 0, -1) if (a, b) != (0, 0)]
    sizes += [(columns + a, rows + b) for a, b in steps]
    return [
        replace(board, columns=c, rows=r) for c, r in dict.fromkeys(sizes) if min(c, r) >= _LEAST
    ]


def _text(board: CircleGrid) -> str:
    kind = "staggered" if board.asymmetric else "straight"
    return f"{board.columns}x{board.rows} discs, {kind}"
