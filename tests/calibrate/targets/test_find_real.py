"""Boards in the data folder's pictures; the calibration they lead to is OpenCV's."""

import os
from collections.abc import Iterable
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.calibrate.targets import RejectedView, find_board
from tagmetry.calibrate.view import BoardView
from tagmetry.files.board_text import parse_board

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[4] / "shared" / "data"))


def pictures(folder: str) -> list[Path]:
    found = sorted(p for p in (DATA / folder).glob("*") if p.suffix.lower() in {".jpg", ".png"})
    if not found:
        pytest.skip(f"no pictures of {folder} in {DATA}; TAGMETRY_DATA names the folder")
    return found


def views(board_text: str, paths: Iterable[Path]) -> list[BoardView]:
    board = parse_board(board_text)
    found = [find_board(cv2.imread(str(path)), board, source=path.name) for path in paths]
    rejected = [(one.source, one.reason) for one in found if isinstance(one, RejectedView)]
    assert rejected == []
    return found


def calibrated(found: list[BoardView]) -> tuple[float, np.ndarray, np.ndarray]:
    """Return OpenCV's RMS, K and five coefficients."""
    points = [view.p_board.astype(np.float32) for view in found]
    pixels = [np.ascontiguousarray(view.corners_px, np.float32) for view in found]
    rms, K, D, _, _ = cv2.calibrateCamera(points, pixels, found[0].size_px, None, None)
    return rms, K, D


def left_out_rms(found: list[BoardView]) -> float:
    """Return the error of every view by the camera of the others, its pose fitted."""
    squares = []
    for i, view in enumerate(found):
        _, K, D = calibrated(found[:i] + found[i + 1 :])
        _, r, t = cv2.solvePnP(view.p_board, view.corners_px, K, D)
        r, t = cv2.solvePnPRefineLM(view.p_board, view.corners_px, K, D, r, t)
        seen = cv2.projectPoints(view.p_board, r, t, K, D)[0].reshape(-1, 2)
        squares.append(((seen - view.corners_px) ** 2).sum(axis=1))
    return float(np.sqrt(np.concatenate(squares).mean()))


def test_opencv_s_chessboards_are_all_found_and_closer_than_by_any_window_of_its_own() -> None:
    """The reference: RMS 0.178, left out 0.183, with the best window of cornerSubPix."""
    found = views("chessboard:9x6:25mm", pictures("chessboard_opencv"))
    assert [len(view.points) for view in found] == [54] * 13
    rms, K, _ = calibrated(found)
    assert rms < 0.165
    assert left_out_rms(found) < 0.170
    assert K[0, 0] == pytest.approx(533.5, abs=1.0)


@pytest.mark.parametrize(
    ("board", "folder", "count", "worst_rms"),
    [
        ("chessboard:7x5:25mm", "house_tour/mapping_feb_2014/calibration", 570, 0.19),
        ("chessboard:11x8:20mm", "small_sets/eye_in_hand_test_data", 528, 0.05),
        pytest.param("charuco:9x7:40mm:20mm:4x4_100",
                     "small_sets/intrinsic_calib_charuco_test_images", 320, 0.316,
                     marks=pytest.mark.slow),
        ("charuco:9x4:114.8mm:90mm:4x4_100:legacy",
         "small_sets/custom_charuco_test_images", 85, 0.1),
        pytest.param("grid:6x4:30.863157mm:7.715789mm:6x6_250",
                     "small_sets/intrinsic_calib_grid_test_images", 660, 0.70,
                     marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_small_sets_are_found_and_fit(
    board: str, folder: str, count: int, worst_rms: float
) -> None:
    found = views(board, pictures(folder))
    assert sum(len(view.points) for view in found) >= count
    assert calibrated(found)[0] < worst_rms


@pytest.mark.slow
@pytest.mark.parametrize(
    ("board", "folder", "count", "worst_rms"),
    [
        ("aprilgrid:6x6:88mm:0.3", "mocap_aprilgrid/cam0/data", 4100, 0.297),
        ("grid:4x5:37.5mm:5mm:6x6_250", "grid_board", 3352, 0.30),
    ],
)
def test_large_sets_are_found_and_fit(
    board: str, folder: str, count: int, worst_rms: float
) -> None:
    test_small_sets_are_found_and_fit(board, folder, count, worst_rms)


def test_natural_pictures_show_no_board() -> None:
    paths = pictures("marker_free")[::70]
    for text in ("chessboard:7x5:25mm", "charuco:7x5:40mm:30mm:5x5_250", "circles:4x3:3cm:1cm"):
        for path in paths:
            image = cv2.imread(str(path))
            result = find_board(image, parse_board(text), thorough=False)
            assert isinstance(result, RejectedView)


def test_a_legacy_board_is_told_from_the_new_one() -> None:
    path = pictures("small_sets/custom_charuco_test_images")[2]
    new = parse_board("charuco:9x4:114.8mm:90mm:4x4_100")
    result = find_board(cv2.imread(str(path)), new)
    assert isinstance(result, RejectedView)
    assert "fit the old layout (legacy)" in result.reason
