"""One call for every board: what is odd about it in pictures."""

from collections.abc import Sequence

from tagmetry.calibrate.doctor.advice import BoardAdvice
from tagmetry.calibrate.doctor.circles import check_circles
from tagmetry.calibrate.doctor.marked import check_marked
from tagmetry.calibrate.doctor.squares import check_chessboard
from tagmetry.detect.grey import SMALLEST_SIDE_PX, grey_8bit
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, CircleGrid, GridBoard


def diagnose_board(pictures: Sequence[AnyPixels], board: Board) -> tuple[BoardAdvice, ...]:
    """Return what is not as it was asked for, problems first; nothing where all is well.

    Args:
        pictures: Some that should show the board, grey or BGR; a handful is enough.
        board: The board asked for.

    Raises:
        InputError: An array is no image.
    """
    greys = [grey_8bit(one) for one in pictures if min(one.shape[:2]) >= SMALLEST_SIDE_PX]
    if not greys:
        return ()
    match board:
        case Chessboard():
            told = check_chessboard(greys, board)
        case CircleGrid():
            told = check_circles(greys, board)
        case CharucoBoard() | GridBoard() | AprilGrid():
            told = check_marked(greys, board)
        case _:
            told = []
    return tuple(sorted(told, key=lambda one: one.severity != "problem"))
