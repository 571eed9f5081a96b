"""Boards of markers whose bits reach beyond their squares: all is found."""

import cv2
import numpy as np
import pytest

from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.files.sheets import board_page
from tagmetry.files.sheets.board import board_tile
from tagmetry.files.sheets.page import Cells
from tagmetry.files.sheets.raster import page_as_pixels
from tagmetry.markers import AprilGrid, Board, CharucoBoard, GridBoard

NAME = "tagStandard41h12"
SIZE_M = 0.02  # printed: 36 mm
PIXELS_PER_M = 3000.0
BOARDS = {
    "grid": GridBoard(3, 2, SIZE_M, 0.024, NAME),
    "charuco": CharucoBoard(3, 3, 0.044, SIZE_M, NAME),
}
every_board = pytest.mark.parametrize("board", BOARDS.values(), ids=BOARDS)


@every_board
def test_all_ink_lies_on_the_tile(board: Board) -> None:
    tile = board_tile(board)
    for shape in tile.shapes:
        if isinstance(shape, Cells):
            assert min(shape.box.x_m, shape.box.y_m) >= 0
            assert shape.box.right_m <= tile.width_m + 1e-9
            assert shape.box.bottom_m <= tile.inked_height_m + 1e-9


@every_board
def test_every_marker_of_a_printed_board_is_found(board: Board) -> None:
    page = board_page(board)
    pixels = cv2.GaussianBlur(page_as_pixels(page, PIXELS_PER_M), (0, 0), 0.7)
    found = Detector([NAME]).detect(pixels)
    assert [one.id for one in found] == list(range(len(board.markers())))
    sides_px = np.array([one.side_px for one in found])
    np.testing.assert_allclose(sides_px, SIZE_M * PIXELS_PER_M, atol=0.05)


def test_markers_that_would_touch_are_refused() -> None:
    with pytest.raises(InputError, match=r"leaves 10 mm between markers.*at least one cell, 20 mm"):
        board_page(GridBoard(3, 2, SIZE_M, 0.01, NAME))


def test_markers_larger_than_their_charuco_square_are_refused() -> None:
    with pytest.raises(InputError, match=r"prints 36 mm.*square of 30 mm; the largest size is 16"):
        board_page(CharucoBoard(3, 3, 0.030, SIZE_M, NAME))


def test_an_aprilgrid_has_no_room_for_outer_bits() -> None:
    with pytest.raises(InputError, match="black squares at its markers' corners"):
        board_page(AprilGrid(3, 2, SIZE_M, 1.2, NAME))
