"""Which corner of an AprilTag is its top left: ours, the AprilTag library's, and OpenCV's.

The library lists corners counter-clockwise from the tag's own bottom left (seen with y up), its
integer coordinates are pixel corners. Ours go clockwise from the top left, integers are centres.
"""

import cv2
import numpy as np
import pytest

from tagmetry.markers import family

pyapriltags = pytest.importorskip("pyapriltags")

CELL_PX, QUIET_PX = 20, 60
OPENCV = {
    "tag36h11": "DICT_APRILTAG_36h11",
    "tag25h9": "DICT_APRILTAG_25h9",
    "tag16h5": "DICT_APRILTAG_16h5",
}
CASES = [("tag36h11", 0), ("tag36h11", 586), ("tag25h9", 3), ("tag16h5", 0), ("tag16h5", 29)]


def with_quiet_zone(marker: np.ndarray) -> np.ndarray:
    return np.pad(marker, QUIET_PX, constant_values=255)


def printed_by_us(name: str, marker_id: int) -> np.ndarray:
    cells = np.where(family(name).picture(marker_id), 255, 0).astype(np.uint8)
    return with_quiet_zone(np.kron(cells, np.ones((CELL_PX, CELL_PX), np.uint8)))


def printed_by_opencv(name: str, marker_id: int) -> np.ndarray:
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, OPENCV[name]))
    side_px = CELL_PX * (dictionary.markerSize + 2)
    return with_quiet_zone(cv2.aruco.generateImageMarker(dictionary, marker_id, side_px))


def corners_of_the_library(name: str, pixels: np.ndarray, marker_id: int) -> np.ndarray:
    """Return the library's corners in our order and our pixels, (4, 2)."""
    detector = pyapriltags.Detector(families=name, quad_decimate=1.0)
    found = [tag for tag in detector.detect(pixels) if tag.tag_id == marker_id]
    assert len(found) == 1
    return found[0].corners[::-1] - 0.5


def square_corners_px(name: str) -> np.ndarray:
    """Return where the black square's corners lie on both prints, from the top left, clockwise."""
    low = QUIET_PX - 0.5
    high = low + CELL_PX * family(name).layout.side_cells
    return np.array([[low, low], [high, low], [high, high], [low, high]])


@pytest.mark.parametrize(("name", "marker_id"), CASES)
def test_our_print_is_upright_for_the_library(name: str, marker_id: int) -> None:
    found = corners_of_the_library(name, printed_by_us(name, marker_id), marker_id)
    np.testing.assert_allclose(found, square_corners_px(name), atol=0.3)


@pytest.mark.parametrize(("name", "marker_id"), CASES)
def test_opencv_s_print_is_on_its_head_for_the_library(name: str, marker_id: int) -> None:
    found = corners_of_the_library(name, printed_by_opencv(name, marker_id), marker_id)
    np.testing.assert_allclose(found, np.roll(square_corners_px(name), 2, axis=0), atol=0.3)


@pytest.mark.parametrize(("name", "marker_id"), CASES)
def test_our_print_is_on_its_head_for_opencv(name: str, marker_id: int) -> None:
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, OPENCV[name]))
    corners, ids, _ = cv2.aruco.ArucoDetector(dictionary).detectMarkers(
        printed_by_us(name, marker_id)
    )
    assert ids.ravel().tolist() == [marker_id]
    expected = np.roll(square_corners_px(name), 2, axis=0)
    np.testing.assert_allclose(corners[0][0], expected, atol=1.0)
