"""What cannot be printed is refused, with the numbers that would fit."""

import pytest
from sheet_shapes import TAG

from tagmetry.errors import InputError
from tagmetry.files.sheets import PageSetup, board_page, marker_page, sheet_pages
from tagmetry.markers import AprilGrid, CharucoBoard, Chessboard, GridBoard


@pytest.mark.parametrize("columns", [1, 2])
def test_the_largest_size_that_a_refusal_names_fits_and_more_does_not(columns: int) -> None:
    board = GridBoard(columns, 2, 0.4, 0.1)
    with pytest.raises(InputError, match=r"the largest size that fits is ([\d.]+) mm") as refusal:
        board_page(board)
    size_m = float(str(refusal.value).split()[-2]) / 1000
    board_page(GridBoard(columns, 2, size_m, size_m / 4))
    with pytest.raises(InputError, match="the largest size"):
        board_page(GridBoard(columns, 2, size_m + 0.0001, size_m / 4 + 0.000025))


def test_a_refusal_tells_what_was_needed_and_what_the_page_leaves() -> None:
    with pytest.raises(
        InputError,
        match=r"size 300 mm needs 375 mm x 379\.5 mm .* leaves 185 mm x 256 mm \(a4 portrait\) or "
        r"272 mm x 169 mm \(a4 landscape\); the largest size that fits is 148 mm",
    ):
        marker_page(TAG, 7, 0.3)


@pytest.mark.parametrize("margin_m", [0.1, 0.105, 3.0])
def test_refuses_margins_that_leave_nothing(margin_m: float) -> None:
    with pytest.raises(InputError, match="too little for the ruler and the caption"):
        marker_page(TAG, 7, 0.01, PageSetup(margin_m=margin_m))


@pytest.mark.parametrize("size_m", [0.0, -1.0, float("nan"), float("inf"), 1e-7])
def test_refuses_sizes_that_cannot_be_printed(size_m: float) -> None:
    with pytest.raises(InputError, match=r"size must be at least 0\.1 mm, got"):
        marker_page(TAG, 7, size_m)


@pytest.mark.parametrize("size_m", [1.0, 1e6, 1e300])
def test_refuses_giants(size_m: float) -> None:
    with pytest.raises(InputError, match="the largest size that fits"):
        marker_page(TAG, 7, size_m)


@pytest.mark.parametrize("marker_id", [-1, 587, 10**30])
def test_refuses_an_id_that_the_family_lacks(marker_id: int) -> None:
    with pytest.raises(InputError, match="tag36h11 has ids 0 to 586, there is no id"):
        marker_page(TAG, marker_id, 0.05)


def test_refuses_an_empty_sheet() -> None:
    with pytest.raises(InputError, match="at least one id"):
        sheet_pages(TAG, [], 0.05)


@pytest.mark.parametrize(
    ("board", "match"),
    [
        (GridBoard(30, 30, 0.001, 0.001), "there is no id 899"),
        (GridBoard(10**9, 10**9, 0.001, 0.001), "there is no id"),
        (GridBoard(2, 2, 0.08, 0.009), r"gap leaves 9 mm .* at least one cell, 10 mm"),
        (AprilGrid(2, 2, 0.08, 0.05), r"spacing leaves 4 mm .* at least one cell, 8 mm"),
        (Chessboard(10**6, 10**6, 0.001), "up to 100000 places, got 1000002000001"),
        (CharucoBoard(40, 40, 0.004, 0.003), "there is no id 799"),
        (Chessboard(8, 5, 1e-9), r"square must be at least 0\.1 mm"),
        (CharucoBoard(5, 7, 0.02, 1e-9), r"size must be at least 0\.1 mm"),
    ],
)
def test_refuses_boards_that_cannot_be_printed(board: GridBoard, match: str) -> None:
    with pytest.raises(InputError, match=match):
        board_page(board)
