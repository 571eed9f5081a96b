"""The closed form for square to quadrilateral, against OpenCV's linear solver."""

import cv2
import numpy as np
import pytest

from tagmetry.geometry import apply_homography, square_to_quad

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def quads(count: int, seed: int = 0) -> np.ndarray:
    """Return convex quadrilaterals: squares with corners moved by up to a third."""
    rng = np.random.default_rng(seed)
    moved = SQUARE + rng.uniform(-0.33, 0.33, (count, 4, 2))
    return moved * rng.uniform(5, 500, (count, 1, 1)) + rng.uniform(-100, 2000, (count, 1, 2))


def test_maps_the_square_s_corners_to_the_quad_s() -> None:
    corners = quads(200)
    found = apply_homography(square_to_quad(corners), SQUARE)
    np.testing.assert_allclose(found, corners, rtol=1e-9)


def test_equals_opencv() -> None:
    for corners in quads(100, seed=1).astype(np.float32):
        expected = cv2.getPerspectiveTransform(SQUARE.astype(np.float32), corners)
        np.testing.assert_allclose(square_to_quad(corners), expected, rtol=1e-5, atol=1e-5)


def test_a_parallelogram_is_affine() -> None:
    H = square_to_quad(np.array([[1.0, 2.0], [5.0, 3.0], [6.0, 7.0], [2.0, 6.0]]))
    np.testing.assert_allclose(H, [[4, 1, 1], [1, 4, 2], [0, 0, 1]])


def test_leading_axes_broadcast() -> None:
    corners = quads(6).reshape(2, 3, 4, 2)
    assert square_to_quad(corners).shape == (2, 3, 3, 3)
    np.testing.assert_array_equal(square_to_quad(corners)[1, 2], square_to_quad(corners[1, 2]))


@pytest.mark.parametrize("middle", [0, 1, 2, 3])
def test_three_corners_on_a_line_have_no_invertible_map(middle: int) -> None:
    corners = SQUARE.copy()
    corners[middle] = (SQUARE[middle - 1] + SQUARE[(middle + 1) % 4]) / 2
    H = square_to_quad(corners)
    assert not np.isfinite(H).all() or abs(np.linalg.det(H)) < 1e-12


def test_a_quad_of_one_point_gives_no_number() -> None:
    assert not np.isfinite(square_to_quad(np.ones((4, 2)))).all()


def test_a_point_on_the_horizon_is_not_finite() -> None:
    H = np.array([[1.0, 0, 0], [0, 1, 0], [1, 0, 0]])
    assert not np.isfinite(apply_homography(H, np.array([[0.0, 1.0]]))).any()
