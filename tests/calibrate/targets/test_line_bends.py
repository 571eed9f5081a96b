"""How lines bend: on arcs of known radius, under perspective, and behind OpenCV's lens."""

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tagmetry.calibrate.targets import bends as subject
from tagmetry.geometry import Array, apply_homography

ROW, COLUMN = np.divmod(np.arange(54), 9)
PLACES = np.stack([COLUMN, -ROW], axis=1) * 0.025


def line_bends(places: Array, corners_px: Array) -> Array:
    return subject.line_bends(places, corners_px).values


def arcs(radius_px: float = 500.0) -> Array:
    """Return a board whose rows are arcs about a point above it, its columns their radii."""
    radius, angle = radius_px + 30 * ROW, 0.06 * (COLUMN - 4)
    return np.stack([300 + radius * np.sin(angle), radius * np.cos(angle) - 300], axis=1)


def test_rows_on_arcs_bend_by_one_over_the_radius() -> None:
    bends = line_bends(PLACES, arcs())
    np.testing.assert_allclose(
        bends[:, 0], -1 / (500 + 30 * ROW), rtol=1e-3
    )  # they rise at the ends
    np.testing.assert_allclose(bends[:, 1], 0.0, atol=1e-12)


@pytest.mark.parametrize("turn_deg", [0.0, 35.0, 180.0])
def test_turned_moved_and_enlarged_pictures_bend_alike(turn_deg: float) -> None:
    turn = Rotation.from_euler("z", turn_deg, degrees=True).as_matrix()[:2, :2]
    other = line_bends(PLACES, 3 * arcs() @ turn.T + [7.0, -20.0])
    np.testing.assert_allclose(other, line_bends(PLACES, arcs()) / 3, rtol=1e-9, atol=1e-12)


def test_in_a_mirrored_picture_they_bend_the_other_way() -> None:
    mirrored = line_bends(PLACES, arcs() * [-1.0, 1.0])
    np.testing.assert_allclose(mirrored, -line_bends(PLACES, arcs()), rtol=1e-9, atol=1e-12)


def test_columns_bend_as_rows_do_when_the_board_lies_on_its_side() -> None:
    lying = np.stack([-PLACES[:, 1], PLACES[:, 0]], axis=1)  # what was right is up
    expected = line_bends(PLACES, arcs())[:, ::-1] * [1.0, -1.0]
    np.testing.assert_allclose(line_bends(lying, arcs()), expected, rtol=1e-9, atol=1e-12)


def test_perspective_bends_nothing() -> None:
    H = np.array([[900.0, 60.0, 320.0], [-40.0, -850.0, 240.0], [1.9, -2.4, 1.0]])
    np.testing.assert_allclose(line_bends(PLACES, apply_homography(H, PLACES)), 0, atol=1e-9)


def seen_by_a_lens(places: Array) -> Array:
    board = np.pad(places - PLACES.mean(axis=0), ((0, 0), (0, 1))) * [1.0, -1.0, 1.0]
    pose = np.array([0.3, -0.5, 0.1]), np.array([0.03, -0.02, 0.25])
    K, D = np.array([[900.0, 0, 640], [0, 900, 480], [0, 0, 1]]), np.array([-0.3, 0.1, 1e-3, 0])
    return cv2.projectPoints(board, *pose, K, D)[0].reshape(-1, 2)


def true_bends(places: Array) -> Array:
    """Return the curvatures by differences of OpenCV's projection."""
    bends = []
    for step in ([1e-3, 0.0], [0.0, -1e-3]):
        before, here, after = (seen_by_a_lens(places + k * np.array(step)) for k in (-1, 0, 1))
        speed, force = (after - before) / 2, after + before - 2 * here
        turn = speed[:, 0] * force[:, 1] - speed[:, 1] * force[:, 0]
        bends.append(turn / np.linalg.norm(speed, axis=1) ** 3)
    return np.stack(bends, axis=1)


def test_behind_a_lens_they_are_those_of_the_lens_to_two_percent() -> None:
    expected = true_bends(PLACES)
    error = line_bends(PLACES, seen_by_a_lens(PLACES)) - expected
    assert np.sqrt((error**2).mean()) < 0.02 * np.abs(expected).max()
    assert np.abs(error).max() < 0.06 * np.abs(expected).max()


def test_the_corners_own_errors_are_smoothed() -> None:
    rng, corners_px = np.random.default_rng(0), seen_by_a_lens(PLACES)
    exact = line_bends(PLACES, corners_px)
    noisy = [line_bends(PLACES, corners_px + rng.normal(0, 0.01, (54, 2))) for _ in range(50)]
    moved_px = (np.array(noisy) - exact) * 16**2 / 6  # of an edge 16 px to both sides
    assert np.sqrt((moved_px**2).mean()) < 0.001


def test_a_board_with_holes_bends_like_the_whole() -> None:
    kept = np.random.default_rng(1).permutation(54)[:40]
    kept.sort()
    expected = true_bends(PLACES)[kept]
    error = line_bends(PLACES[kept], seen_by_a_lens(PLACES[kept])) - expected
    assert np.sqrt((error**2).mean()) < 0.03 * np.abs(expected).max()


@pytest.mark.parametrize("kept", [[], [0], [0, 1], [0, 9, 18 + 1], [0, 1, 9, 10]])
def test_where_no_three_lie_on_a_line_nothing_is_said(kept: list[int]) -> None:
    found = line_bends(PLACES[kept], arcs()[kept])
    np.testing.assert_array_equal(found, np.zeros((len(kept), 2)))


def test_a_single_row_tells_of_rows_only() -> None:
    found = line_bends(PLACES[:9], arcs()[:9])
    np.testing.assert_allclose(found[:, 0], -1 / 500, rtol=1e-3)
    np.testing.assert_array_equal(found[:, 1], 0)


def test_where_the_lens_bends_as_nowhere_else_it_is_in_doubt() -> None:
    """The picture's rim is pushed out by a step within the last square."""
    corners_px = seen_by_a_lens(PLACES)
    usual = subject.line_bends(PLACES, corners_px).doubts
    wild = corners_px + np.where(COLUMN == 8, 2.0, 0.0)[:, None] * [0.3, 1.0]
    doubts = subject.line_bends(PLACES, wild).doubts
    assert np.abs(usual).max() < 0.15 * np.abs(true_bends(PLACES)).max()
    assert doubts[COLUMN == 8, 0].min() > 3 * usual[:, 0].max()
