"""Boards against OpenCV's, turned into our frame, and against Kalibr's numbering."""

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, GridBoard

DICTIONARY = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_250)
SIZES = [(5, 7), (6, 4), (3, 3), (4, 5), (2, 2)]
BOARDS = {
    "grid": GridBoard(4, 3, 0.05, 0.02, "5x5_250"),
    "aprilgrid": AprilGrid(6, 5, 0.088, 0.3),
    "chessboard": Chessboard(9, 6, 0.025),
    "charuco": CharucoBoard(5, 7, 0.04, 0.03),
    "legacy": CharucoBoard(5, 8, 0.04, 0.03, legacy=True),
}
every_board = pytest.mark.parametrize("board", BOARDS.values(), ids=BOARDS)


def from_opencv(board: Board, points: np.ndarray) -> np.ndarray:
    """Turn OpenCV's board coordinates (top left, y down) into ours (centre, y up)."""
    centred = np.asarray(points, dtype=float) - [board.width_m / 2, board.height_m / 2, 0]
    return centred * [1, -1, 1]


def corners(board: Board) -> np.ndarray:
    return np.stack([marker.corners_m for marker in board.markers()])


def ids(board: Board) -> list[int]:
    return [marker.id for marker in board.markers()]


@pytest.mark.parametrize(("columns", "rows"), SIZES)
def test_a_grid_is_opencv_s(columns: int, rows: int) -> None:
    ours = GridBoard(columns, rows, 0.05, 0.013, "5x5_250", first_id=9)
    places = np.arange(9, 9 + columns * rows)
    theirs = cv2.aruco.GridBoard((columns, rows), 0.05, 0.013, DICTIONARY, places)
    assert ids(ours) == theirs.getIds().ravel().tolist()
    np.testing.assert_allclose(corners(ours), from_opencv(ours, theirs.getObjPoints()), atol=1e-7)


@pytest.mark.parametrize("legacy", [False, True])
@pytest.mark.parametrize(("columns", "rows"), SIZES)
def test_a_charuco_board_is_opencv_s(columns: int, rows: int, legacy: bool) -> None:
    ours = CharucoBoard(columns, rows, 0.04, 0.03, legacy=legacy)
    theirs = cv2.aruco.CharucoBoard((columns, rows), 0.04, 0.03, DICTIONARY)
    theirs.setLegacyPattern(legacy)
    assert ids(ours) == theirs.getIds().ravel().tolist()
    np.testing.assert_allclose(corners(ours), from_opencv(ours, theirs.getObjPoints()), atol=1e-7)
    expected = from_opencv(ours, theirs.getChessboardCorners())
    np.testing.assert_allclose(ours.corners_m, expected, atol=1e-7)


def drawn(board: Board, px_per_m: float) -> np.ndarray:
    """Return the board's plain black squares as an image."""
    width, height = round(board.width_m * px_per_m), round(board.height_m * px_per_m)
    pixels = np.full((height, width), 255, np.uint8)
    for x, y, side in board.black_squares_m():
        left, right = (np.array([x, x + side]) + board.width_m / 2) * px_per_m
        top, bottom = (board.height_m / 2 - np.array([y + side, y])) * px_per_m
        pixels[round(top) : round(bottom), round(left) : round(right)] = 0
    return pixels


@pytest.mark.parametrize("legacy", [False, True])
@pytest.mark.parametrize(("columns", "rows"), SIZES)
def test_a_charuco_board_s_squares_are_opencv_s(columns: int, rows: int, legacy: bool) -> None:
    ours = CharucoBoard(columns, rows, 0.04, 0.03, legacy=legacy)
    theirs = cv2.aruco.CharucoBoard((columns, rows), 0.04, 0.03, DICTIONARY)
    theirs.setLegacyPattern(legacy)
    expected = theirs.generateImage((columns * 40, rows * 40), marginSize=0)
    edge = slice(2, None, 40)  # near a square's edge a white square shows no marker
    np.testing.assert_array_equal(drawn(ours, 1000)[edge, edge], expected[edge, edge])


def test_only_an_even_legacy_board_begins_white() -> None:
    begins = {
        (legacy, rows): CharucoBoard(5, rows, 0.04, 0.03, legacy=legacy).first_black
        for legacy in (False, True)
        for rows in (6, 7)
    }
    assert begins == {(False, 6): True, (False, 7): True, (True, 6): False, (True, 7): True}


def test_a_charuco_board_s_first_id_moves_all() -> None:
    assert ids(CharucoBoard(3, 3, 0.04, 0.03, first_id=50)) == [50, 51, 52, 53]


def test_a_chessboard_is_found_where_it_says() -> None:
    board, px_per_m, margin = Chessboard(7, 5, 0.04), 1000, 40
    pixels = np.pad(drawn(board, px_per_m), margin, constant_values=255)
    found, pixel = cv2.findChessboardCornersSB(pixels, (7, 5))
    assert found
    x, y = board.corners_m[:, 0] + board.width_m / 2, board.height_m / 2 - board.corners_m[:, 1]
    expected = np.stack([x, y], axis=1) * px_per_m + margin - 0.5
    pixel = pixel.reshape(-1, 2)
    if pixel[0, 0] > pixel[-1, 0]:
        pixel = pixel[::-1]  # the detector may begin at the other end
    np.testing.assert_allclose(pixel, expected, atol=0.6)


def test_a_chessboard_s_corners_run_from_the_top_left_along_rows() -> None:
    found = Chessboard(3, 2, 0.1).corners_m
    expected = [[-0.1, 0.05], [0, 0.05], [0.1, 0.05], [-0.1, -0.05], [0, -0.05], [0.1, -0.05]]
    np.testing.assert_allclose(found, np.pad(expected, ((0, 0), (0, 1))), atol=1e-15)


def test_a_chessboard_begins_black_and_alternates() -> None:
    pixels = drawn(Chessboard(3, 2, 0.1), 10)
    np.testing.assert_array_equal(pixels == 0, np.indices((3, 4)).sum(axis=0) % 2 == 0)


def test_an_aprilgrid_counts_from_the_bottom_left_as_kalibr_does() -> None:
    board = AprilGrid(3, 2, 0.1, 0.3)
    centres = {marker.id: marker.T_body_marker.translation for marker in board.markers()}
    pitch_m = 0.1 * 1.3
    for marker_id, (column, row) in enumerate((c, r) for r in range(2) for c in range(3)):
        expected = [(column - 1) * pitch_m, (row - 0.5) * pitch_m, 0]
        np.testing.assert_allclose(centres[marker_id], expected, atol=1e-12)


def test_an_aprilgrid_is_kalibr_s_in_kalibr_s_coordinates() -> None:
    """Kalibr's origin is the lower left corner of tag 0, x to the right, y up."""
    columns, rows, size_m, spacing = 4, 3, 0.088, 0.3
    board = AprilGrid(columns, rows, size_m, spacing)
    points = corners(board)[:, [3, 2, 1, 0]] - corners(board)[0, 3]
    for place, tag in enumerate(points):
        row, column = divmod(place, columns)
        left, low = np.array([column, row]) * (1 + spacing) * size_m
        expected = np.array([[left, low], [left + size_m, low]])
        np.testing.assert_allclose(tag[:2, :2], expected, atol=1e-12)
        np.testing.assert_allclose(tag[[3, 2], :2], expected + np.array([0, size_m]), atol=1e-12)


def test_small_squares_touch_the_corners_of_the_tags() -> None:
    board = AprilGrid(3, 2, 0.1, 0.25)
    lower_left = board.black_squares_m()[:, :2]
    side = board.black_squares_m()[:, 2:]
    assert len(lower_left) == 4 * 3
    np.testing.assert_allclose(side, 0.025)
    steps = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    square_corners = (lower_left[:, None] + side[:, None] * steps).reshape(-1, 2)
    for tag in corners(board)[:, :, :2]:
        for corner in tag:
            touching = np.linalg.norm(square_corners - corner, axis=1) < 1e-12
            assert touching.sum() == 1
    middle = corners(board).mean(axis=1)[:, None, :2]
    inside = (np.abs(lower_left + side / 2 - middle) < 0.05).all(axis=-1)
    assert not inside.any()


@every_board
def test_a_board_is_centred_and_flat(board: Board) -> None:
    squares = board.black_squares_m()
    low, high = squares[:, :2], squares[:, :2] + squares[:, 2:]
    of_markers = [corner[:2] for marker in board.markers() for corner in marker.corners_m]
    points = [*low, *high, *of_markers]
    np.testing.assert_allclose(np.min(points, axis=0), [-board.width_m / 2, -board.height_m / 2])
    np.testing.assert_allclose(np.max(points, axis=0), [board.width_m / 2, board.height_m / 2])
    assert all(marker.T_body_marker.translation[2] == 0 for marker in board.markers())


@pytest.mark.parametrize(
    ("name", "title"), [("grid", "4x3 5x5_250"), ("aprilgrid", "6x5 tag36h11_border2"),
                        ("charuco", "ChArUco 5x7")]
)  # fmt: skip
def test_a_board_of_markers_is_a_body(name: str, title: str) -> None:
    board = BOARDS[name]
    assert board.body().name == title
    assert list(board.body().corners_m) == [(m.family, m.id) for m in board.markers()]
    np.testing.assert_array_equal(list(board.body().corners_m.values()), corners(board))


def test_a_plain_board_has_no_markers_and_a_grid_no_squares() -> None:
    assert BOARDS["chessboard"].markers() == ()
    assert BOARDS["grid"].black_squares_m().shape == (0, 3)


def test_a_large_board_is_a_body_at_once() -> None:
    assert len(GridBoard(100, 100, 0.01, 0.01, "any").body().markers) == 10_000


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: GridBoard(0, 3, 0.1, 0.1), "at least 1x1, got 0x3"),
        (lambda: GridBoard(3, -1, 0.1, 0.1), "at least 1x1, got 3x-1"),
        (lambda: GridBoard(3, 3, 0.0, 0.1), "size_m must be positive, got 0.0"),
        (lambda: GridBoard(3, 3, 0.1, np.nan), "gap_m must be positive, got nan"),
        (lambda: AprilGrid(0, 1, 0.1, 0.3), "at least 1x1"),
        (lambda: AprilGrid(1, 1, np.inf, 0.3), "size_m must be positive, got inf"),
        (lambda: AprilGrid(1, 1, 0.1, -0.3), "spacing must be positive"),
        (lambda: Chessboard(1, 5, 0.1), "at least 2x2, got 1x5"),
        (lambda: Chessboard(5, 5, 0.0), "square_m must be positive"),
        (lambda: CharucoBoard(5, 1, 0.1, 0.05), "at least 2x2, got 5x1"),
        (lambda: CharucoBoard(5, 5, -0.1, 0.05), "square_m must be positive"),
        (lambda: CharucoBoard(5, 5, 0.1, 0.1), "smaller than its square, got 0.1 m in 0.1 m"),
    ],
)
def test_refuses_a_board_that_cannot_be(make: object, text: str) -> None:
    with pytest.raises(InputError, match=text):
        make()
