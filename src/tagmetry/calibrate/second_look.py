"""A second look at the corners, through the camera that the first look gave.

A first calibration needs no more than corners that are about right. It then says how every edge of
the board bends in every view, the corners are fitted to the pixels again with edges bent like that,
and the camera is solved again.
"""

from collections.abc import Sequence

from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.targets.edges import predicted_edges
from tagmetry.calibrate.targets.patches import Patches
from tagmetry.calibrate.targets.refit import refitted
from tagmetry.calibrate.view import BoardView
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard


def look_again(
    calibration: Calibration, patches: Sequence[Patches | None], board: Board
) -> tuple[BoardView, ...]:
    """Return the views of a calibration with their corners fitted as its camera shows them.

    Args:
        calibration: A first one.
        patches: The pixels around the corners of each of its views (`BoardFindings.patches`); a
            view without any stays as it is.
        board: What was looked for.
    """
    return tuple(
        _seen_again(calibration, number, around, board) for number, around in enumerate(patches)
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
