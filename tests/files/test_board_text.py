"""Boards as text: what is typed, and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.files.board_text import board_text, parse_board
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, CircleGrid, GridBoard

counts = st.integers(2, 30)
lengths_m = st.floats(1e-5, 10.0)
first_ids = st.integers(0, 999)
families = st.sampled_from(["4x4_50", "5x5_250", "tag36h11", "tag36h11_border2", "aruco_original"])
boards = st.one_of(
    st.builds(Chessboard, counts, counts, lengths_m),
    st.builds(
        lambda columns, rows, side_m, *others: CharucoBoard(
            columns, rows, side_m, 0.7 * side_m, *others
        ),
        counts, counts, lengths_m, families, first_ids, st.booleans(),
    ),
    st.builds(
        lambda columns, rows, pitch_m, asymmetric: CircleGrid(
            columns, rows, pitch_m, 0.6 * pitch_m, asymmetric
        ),
        counts, counts, lengths_m, st.booleans(),
    ),
    st.builds(AprilGrid, counts, counts, lengths_m, lengths_m, families, first_ids),
    st.builds(GridBoard, counts, counts, lengths_m, lengths_m, families, first_ids, st.booleans()),
)  # fmt: skip


@given(boards)
def test_reading_inverts_writing(board: Board) -> None:
    assert parse_board(board_text(board)) == board


@pytest.mark.parametrize(
    ("text", "board"),
    [
        ("chessboard:9x6:25mm", Chessboard(9, 6, 0.025)),
        (" chessboard : 9x6 : 1in ", Chessboard(9, 6, 0.0254)),
        ("charuco:7x5:30mm:22mm:5x5_100", CharucoBoard(7, 5, 0.03, 0.022, "5x5_100")),
        ("charuco:4x5:54mm:40.5mm:DICT_4X4_1000:legacy",
         CharucoBoard(4, 5, 0.054, 0.0405, "4x4_1000", legacy=True)),
        ("charuco:7x5:30mm:22mm:5x5_100:12:legacy",
         CharucoBoard(7, 5, 0.03, 0.022, "5x5_100", 12, legacy=True)),
        ("circles:7x5:3cm:15mm", CircleGrid(7, 5, 0.03, 0.015)),
        ("asymmetric-circles:4x11:20mm:15mm", CircleGrid(4, 11, 0.02, 0.015, asymmetric=True)),
        ("aprilgrid:6x6:88mm:0.3", AprilGrid(6, 6, 0.088, 0.3)),
        ("aprilgrid:6x6:88mm:.3:tag25h9:4", AprilGrid(6, 6, 0.088, 0.3, "tag25h9", 4)),
        ("grid:4x5:37.5mm:5mm:6x6_250:3", GridBoard(4, 5, 0.0375, 0.005, "6x6_250", 3)),
    ],
)  # fmt: skip
def test_reads_what_people_type(text: str, board: Board) -> None:
    assert parse_board(text) == board


def test_an_aprilgrid_s_spacing_may_be_a_length() -> None:
    board = parse_board("aprilgrid:6x6:88mm:26.4mm")
    assert isinstance(board, AprilGrid)
    assert board.spacing == pytest.approx(0.3, abs=1e-12)


def test_millimetres_are_written_where_they_are_exact() -> None:
    assert board_text(Chessboard(9, 6, 0.025)) == "chessboard:9x6:25mm"
    assert board_text(Chessboard(9, 6, np.float64(1 / 3))) == "chessboard:9x6:0.3333333333333333"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected a board as chessboard:…, charuco:…, .* found ''"),
        ("checkers:9x6:25mm", "for example chessboard:9x6:25mm, with 9x6 inner corners"),
        ("chessboard", "expected chessboard:COLUMNSxROWS:SQUARE .* found 0 parts"),
        ("chessboard:9x6", "found 1 parts"),
        ("chessboard:9x6:25mm:5", "found 3 parts"),
        ("chessboard:9*6:25mm", "expected COLUMNSxROWS like 9x6 .* found '9\\*6'"),
        ("chessboard:9x600:25mm", "at most 200 columns or rows"),
        ("chessboard:9x6:25px", "expected a length above 0"),
        ("chessboard:9x6:-1", "expected a length above 0"),
        ("chessboard:1x6:25mm", "at least 2x2, got 1x6"),
        ("charuco:7x5:30mm:31mm:5x5_100", "must be smaller than its square"),
        ("charuco:7x5:30mm:22mm:5x5_99", "unknown marker family '5x5_99'"),
        ("charuco:7x5:30mm:22mm:5x5_100:old", "expected charuco:.* found 'old'"),
        ("charuco:7x5:30mm:22mm:5x5_100:legacy:3", "found 'legacy'"),
        ("circles:7x5:30mm:30mm", "discs must not touch"),
        ("aprilgrid:6x6:88mm:0", "spacing must be positive"),
        ("aprilgrid:6x6:88mm:0.3:tag36h11:x", "found 'x'"),
        ("grid:4x5:37mm:5mm", "expected grid:.* found 3 parts"),
        ("x" * 5000, "…'; for example"),
    ],
)
def test_refuses_what_describes_no_board(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message) as refused:
        parse_board(text)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 700


@given(st.text(max_size=40))
def test_any_text_is_a_board_or_an_input_error(text: str) -> None:
    for line in (text, f"chessboard:{text}", f"charuco:5x5:{text}", f"grid:2x2:1:1:4x4_50:{text}"):
        try:
            board = parse_board(line)
        except InputError:
            continue
        assert parse_board(board_text(board)) == board


def test_refuses_a_board_of_another_kind() -> None:
    with pytest.raises(InputError, match="a board of type object has no text form"):
        board_text(object())
