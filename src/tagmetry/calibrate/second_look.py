"""A second look at the corners, through the camera that the first look gave.

A first calibration needs no more than corners that are about right. It then says how every edge of
the board bends in every view, the corners are fitted to the pixels again with edges bent like that,
and the camera is solved again.
"""

from collections.abc import Iterable
from typing import Protocol

from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.targets.edges import predicted_edges
from tagmetry.calibrate.targets.patches import Patches
from tagmetry.calibrate.targets.refit import refitted
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard


class Looked(Protocol):
    """What looking for a board in a picture gave, as `explain_board` does."""

    @property
    def result(self) -> BoardView | RejectedView:
        """The view, or why there is none."""

    @property
    def patches(self) -> Patches | None:
        """The pixels around the view's corners, where these are crossings of edges."""


def look_again(
    calibration: Calibration, looked: Iterable[Looked], board: Board
) -> tuple[BoardView, ...]:
    """Return the views of a calibration with their corners fitted as its camera shows them.

    Args:
        calibration: A first one.
        looked: What its pictures gave. A view that is not among them or has no patches stays as
            it is.
        board: What was looked for.
    """
    patches = {id(one.result): one.patches for one in looked}
    return tuple(
        _seen_again(calibration, number, patches.get(id(view)), board)
        for number, view in enumerate(calibration.views)
    )


def _seen_again(
    calibration: Calibration, number: int, patches: Patches | None, board: Board
) -> BoardView:
    view = calibration.views[number]
    step_m = _edge_m(board)
    if patches is None or step_m is None:
        return view
    T_camera_board = calibration.Ts_camera_board[number]
    p_board = calibration.p_board[view.points]
    edges = predicted_edges(calibration.camera, T_camera_board, p_board, step_m)
    return refitted(view, patches, edges)


def _edge_m(board: Board) -> float | None:
    """Return the length of the edges that cross at a corner; None where none do."""
    match board:
        case Chessboard() | CharucoBoard():
            return board.square_m
        case AprilGrid():
            return board.size_m
    return None
