"""Where the black squares of a board stand."""

import numpy as np

from tagmetry.geometry import Array
from tagmetry.markers import CharucoBoard, Chessboard
from tagmetry.twin.scenes import Sheet


def squares_m(board: Chessboard | CharucoBoard) -> list[Array]:
    """The corners of the black squares on the board."""
    return [
        Sheet(side, side).corners_m + np.array([left + side / 2, low + side / 2, 0.0])
        for left, low, side in board.black_squares_m()
    ]
