"""Printed sheets are read by OpenCV's own detectors, which share no code with the printing."""

import cv2
import numpy as np
import pytest

from tagmetry.files.sheets import Page, PageSetup, board_page, marker_page, parse_paper, sheet_pages
from tagmetry.files.sheets.page import Cells
from tagmetry.files.sheets.raster import page_as_pixels
from tagmetry.geometry import Array
from tagmetry.markers import AprilGrid, CharucoBoard, Chessboard, GridBoard, family

PIXELS_PER_M = 8000.0
DICTIONARIES = {
    "4x4_50": cv2.aruco.DICT_4X4_50,
    "6x6_250": cv2.aruco.DICT_6X6_250,
    "aruco_original": cv2.aruco.DICT_ARUCO_ORIGINAL,
    "tag36h11": cv2.aruco.DICT_APRILTAG_36h11,
    "tag25h9": cv2.aruco.DICT_APRILTAG_25h9,
}


def detected(page: Page, name: str, **parameters: object) -> dict[int, Array]:
    """Corners by id, pixels with integers at pixel centres."""
    wanted = cv2.aruco.DetectorParameters()
    wanted.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    for key, setting in parameters.items():
        setattr(wanted, key, setting)
    dictionary = cv2.aruco.getPredefinedDictionary(DICTIONARIES[name])
    pixels = page_as_pixels(page, PIXELS_PER_M)
    corners, ids, _ = cv2.aruco.ArucoDetector(dictionary, wanted).detectMarkers(pixels)
    assert len(ids) == len(set(ids.ravel().tolist()))
    turn = 2 if name.startswith("tag") else 0  # OpenCV's AprilTags stand on their heads
    return {int(i): np.roll(c[0], -turn, axis=0) for i, c in zip(ids.ravel(), corners, strict=True)}


def printed_corners_px(cells: Cells) -> Array:
    box = cells.box
    x, y = [box.x_m, box.right_m], [box.y_m, box.bottom_m]
    corners_m = np.array([[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]])
    return corners_m * PIXELS_PER_M - 0.5


def markers(page: Page) -> list[Cells]:
    return [s for s in page.shapes if isinstance(s, Cells) and s.filled.size > 1]


@pytest.mark.parametrize("name", DICTIONARIES)
def test_a_sheet_is_read_with_its_ids_and_corners(name: str) -> None:
    (page, *_) = sheet_pages(family(name), range(2, 14), 0.03)
    found = detected(page, name)
    assert set(found) == set(range(2, 14))
    for marker_id, cells in zip(range(2, 14), markers(page), strict=True):
        np.testing.assert_allclose(found[marker_id], printed_corners_px(cells), atol=0.3)


def test_an_inverted_marker_is_read_as_such() -> None:
    page = marker_page(family("4x4_50"), 7, 0.05, PageSetup(inverted=True))
    assert set(detected(page, "4x4_50", detectInvertedMarker=True)) == {7}


def test_a_grid_is_read_in_the_order_of_opencv() -> None:
    page = board_page(GridBoard(3, 2, 0.04, 0.01, "6x6_250", first_id=5))
    theirs = cv2.aruco.GridBoard(
        (3, 2),
        0.04,
        0.01,
        cv2.aruco.getPredefinedDictionary(DICTIONARIES["6x6_250"]),
        np.arange(5, 11),
    )
    found = detected(page, "6x6_250")
    first = found[5][0] / PIXELS_PER_M
    for marker_id, corners_m in zip(range(5, 11), theirs.getObjPoints(), strict=True):
        measured_m = found[marker_id] / PIXELS_PER_M - first
        np.testing.assert_allclose(measured_m, corners_m[:, :2], atol=5e-5)


def test_an_aprilgrid_counts_up_from_the_bottom_left_with_squares_at_the_corners() -> None:
    board = AprilGrid(3, 2, 0.04, 0.3)
    page = board_page(board)
    found = detected(page, "tag36h11", markerBorderBits=2)
    assert set(found) == set(range(6))
    assert found[0][3, 1] > found[3][3, 1] + 0.05 * PIXELS_PER_M
    assert found[1][0, 0] - found[0][0, 0] == pytest.approx(0.052 * PIXELS_PER_M, abs=0.4)
    pixels = page_as_pixels(page, PIXELS_PER_M)
    for x, y in found[0] + 0.006 * PIXELS_PER_M * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]):
        assert pixels[round(y), round(x)] == 0


@pytest.mark.parametrize(("columns", "rows"), [(5, 7), (5, 6)])
@pytest.mark.parametrize("legacy", [False, True])
def test_a_charuco_board_is_read_with_all_its_corners(
    columns: int, rows: int, legacy: bool
) -> None:
    page = board_page(CharucoBoard(columns, rows, 0.03, 0.022, "6x6_250", legacy=legacy))
    dictionary = cv2.aruco.getPredefinedDictionary(DICTIONARIES["6x6_250"])
    theirs = cv2.aruco.CharucoBoard((columns, rows), 0.03, 0.022, dictionary)
    theirs.setLegacyPattern(legacy)
    pixels = page_as_pixels(page, PIXELS_PER_M)
    corners, ids, _, _ = cv2.aruco.CharucoDetector(theirs).detectBoard(pixels)
    expected_m = theirs.getChessboardCorners()[:, :2]
    np.testing.assert_array_equal(np.sort(ids.ravel()), np.arange(len(expected_m)))
    measured_m = corners.reshape(-1, 2)[np.argsort(ids.ravel())] / PIXELS_PER_M
    np.testing.assert_allclose(
        measured_m - measured_m[0], expected_m - expected_m[0], atol=0.3 / PIXELS_PER_M
    )


def test_a_chessboard_is_read_with_its_squares_at_their_size() -> None:
    pixels = page_as_pixels(board_page(Chessboard(7, 4, 0.02)), PIXELS_PER_M)
    found, corners = cv2.findChessboardCornersSB(pixels, (7, 4))
    assert found
    grid = corners.reshape(4, 7, 2)
    np.testing.assert_allclose(
        np.linalg.norm(np.diff(grid, axis=1), axis=2), 0.02 * PIXELS_PER_M, atol=0.3
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", DICTIONARIES)
def test_every_id_of_a_family_is_read(name: str) -> None:
    setup = PageSetup(parse_paper("a3"))
    tags = family(name)
    ids = range(min(len(tags), 250))
    found = [set(detected(page, name)) for page in sheet_pages(tags, ids, 0.02, setup)]
    assert set().union(*found) == set(ids)
