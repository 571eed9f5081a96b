"""Is the board of markers the one that was asked for? Its ids and their places tell."""

from collections.abc import Sequence

import numpy as np

from tagmetry.calibrate.doctor.advice import BoardAdvice
from tagmetry.calibrate.doctor.arrangement import Fitting, best_fitting, fitting
from tagmetry.calibrate.doctor.lattice import largest_lattice, voted
from tagmetry.calibrate.doctor.layouts import (
    MarkedBoard,
    arrangement_of,
    as_asked,
    board_as,
    differences,
    side_in_steps,
    told,
)
from tagmetry.calibrate.doctor.sought import Markers, markers_of, other_family
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import Board, Chessboard

_FITS = 0.85  # share of the markers in their places
_SOME = 2  # markers out of place
_BETTER = 0.25  # times as many out of place: in a layout moved by one, few are
_OTHER_SIZE = 0.04
_FEW = 4


def check_marked(greys: Sequence[GreyPixels], board: MarkedBoard) -> list[BoardAdvice]:
    """Return what is odd about a board of markers; nothing where it is as asked for."""
    seen = markers_of(greys, board.family)
    if max(map(len, seen)) < _FEW:
        return _wrong_family(greys, board)
    return [*_arranged(seen, board), *_inverted(seen)]


def seen_instead(greys: Sequence[GreyPixels], board: Board) -> list[BoardAdvice]:
    """Return which board of markers is seen, where one without was asked for."""
    found = other_family(greys)
    if found is None:
        return []
    seen = markers_of(greys, found.name)
    best = best_fitting(seen, None, _first_ids(seen, 0))
    if best is None or best.share < _FITS:
        return []
    step_m = _step_m(board)
    instead = board_as(best, found.name, best.rows, step_m)
    return [
        BoardAdvice(
            "problem",
            "a board of markers is seen",
            f"a {told(board)}",
            f"a {told(instead)} of {found.name}",
            "its lengths are a guess: measure them",
            instead,
        )
    ]


def _wrong_family(greys: Sequence[GreyPixels], board: MarkedBoard) -> list[BoardAdvice]:
    """Say that the markers are of another family, or that there are none at all."""
    found = other_family(greys)
    if found is not None and found.name == board.family:
        return []
    if found is None:
        return _no_markers(greys, board)
    seen = markers_of(greys, found.name)
    ids = sorted({one.id for markers in seen for one in markers})
    other: Board = as_asked(board, found.name)
    arranged = _arranged(seen, as_asked(board, found.name))
    if arranged:
        other = arranged[0].board or other
    advice = BoardAdvice(
        "problem",
        "another family of markers",
        f"markers of {board.family}",
        f"{found.name} with {len(ids)} ids from {ids[0]} to {ids[-1]}",
        board=other,
    )
    return [advice, *arranged, *_inverted(seen)]


def _no_markers(greys: Sequence[GreyPixels], board: MarkedBoard) -> list[BoardAdvice]:
    counts = [size for grey in greys if (size := largest_lattice(grey)) is not None]
    if not counts:
        return []
    (columns, rows), count = voted(counts)
    return [
        BoardAdvice(
            "problem",
            "a plain chessboard is seen",
            f"a {told(board)}",
            f"no markers, and {columns}x{rows} inner corners in {count} of {len(greys)} pictures",
            "check the square's side",
            Chessboard(columns, rows, _step_m(board)),
        )
    ]


def _arranged(seen: Sequence[Markers], board: MarkedBoard) -> list[BoardAdvice]:
    """Say how the markers are arranged where it is not as asked for."""
    asked = fitting(seen, arrangement_of(board))
    if asked.seen == 0:
        return []
    if asked.astray >= _SOME:
        best = best_fitting(seen, asked.arrangement, _first_ids(seen, board.first_id))
        if best is not None and best.share >= _FITS and best.astray <= _BETTER * asked.astray:
            return [_otherwise(asked, best, board)]
    return (_bounds(asked, seen, board) or _sizes(asked, board)) if asked.share >= _FITS else []


def _otherwise(asked: Fitting, best: Fitting, board: MarkedBoard) -> BoardAdvice:
    instead = board_as(best, board.family, _rows(best, board), side_in_steps(board).step_m, board)
    titles = differences(board, instead)
    return BoardAdvice(
        "problem",
        " and ".join(titles) or "arranged otherwise",
        f"a {told(board)}",
        f"a {told(instead)}: {best.agreeing} of {best.seen} markers fit it, "
        f"{asked.agreeing} fit what was asked for",
        board=instead,
    )


def _rows(best: Fitting, board: MarkedBoard) -> int:
    """Return how many rows the board has: as asked for, unless more are seen or it is turned."""
    columns = best.arrangement.columns
    if columns == board.rows != board.columns and 0 <= board.columns - best.rows <= 1:
        rows = board.columns
    elif columns == board.columns and best.rows <= board.rows:
        rows = board.rows
    else:
        rows = best.rows
    needs_even = best.arrangement.kind == "charuco" and best.arrangement.flag
    return rows + rows % 2 if needs_even else rows


def _bounds(asked: Fitting, seen: Sequence[Markers], board: MarkedBoard) -> list[BoardAdvice]:
    """Say that the board goes on below its last row."""
    if asked.rows <= board.rows:
        return []
    step_m = side_in_steps(board).step_m
    instead = board_as(asked, board.family, asked.rows, step_m, board)
    highest = max(one.id for markers in seen for one in markers)
    return [
        BoardAdvice(
            "hint",
            "only a part of the board is used",
            f"a {told(board)}",
            f"ids up to {highest}, which are in their places when it has {asked.rows} rows",
            board=instead,
        )
    ]


def _sizes(asked: Fitting, board: MarkedBoard) -> list[BoardAdvice]:
    """Say that the markers are larger or smaller against their distance than asked for."""
    wanted = side_in_steps(board)
    if abs(asked.side / wanted.side - 1) < _OTHER_SIZE:
        return []
    instead = board_as(asked, board.family, board.rows, wanted.step_m, board, side=asked.side)
    return [
        BoardAdvice(
            "problem",
            "another size of markers",
            f"markers of {wanted.side:.3f} of the step from one place to the next",
            f"{asked.side:.3f}",
            f"measure both; if the step of {wanted.step_m * 1e3:g} mm is right, the markers' side "
            f"is {asked.side * wanted.step_m * 1e3:.1f} mm",
            instead,
        )
    ]


def _inverted(seen: Sequence[Markers]) -> list[BoardAdvice]:
    every = [one.is_inverted for markers in seen for one in markers]
    if np.mean(every) <= 0.5:
        return []
    return [
        BoardAdvice(
            "hint",
            "printed white on black",
            "black markers on white",
            f"{sum(every)} of {len(every)} markers inverted",
            "they are found all the same; other programs will not find them",
        )
    ]


def _first_ids(seen: Sequence[Markers], asked: int) -> list[int]:
    """Return ids that may be the board's first: as asked for, none, the lowest seen."""
    counts: dict[int, int] = {}
    for markers in seen:
        for one in markers:
            counts[one.id] = counts.get(one.id, 0) + 1
    return list(dict.fromkeys([asked, 0, min(counts, default=0)]))


def _step_m(board: Board) -> float:
    """Return the distance from one point of the board to the next."""
    return float(np.linalg.norm(board.corners_m[1:] - board.corners_m[0], axis=1).min())
