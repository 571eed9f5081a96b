"""Grey values between pixels, beside OpenCV's and outside of the image."""

import cv2
import numpy as np
import pytest

from tagmetry.detect.places import first_per_place, in_places
from tagmetry.detect.reading.sample import cell_means, look_up, new_room, write_steps

RNG = np.random.default_rng(0)
GREY = RNG.integers(0, 256, (60, 80)).astype(np.uint8)


def values_at(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    room = new_room(len(x))
    room.x[:], room.y[:] = x, y
    look_up(GREY, room, len(x))
    return room.values


def test_between_pixels_it_is_as_opencv_says() -> None:
    x, y = RNG.uniform(0, 78.9, 500), RNG.uniform(0, 58.9, 500)
    expected = cv2.remap(
        GREY.astype(np.float32),
        x.astype(np.float32)[None],
        y.astype(np.float32)[None],
        cv2.INTER_LINEAR,
    )[0]
    np.testing.assert_allclose(values_at(x, y), expected, atol=255 / 32)  # its places are 1/32 px


def test_on_pixels_it_is_their_value() -> None:
    rows, columns = np.mgrid[:59, :79].reshape(2, -1)
    np.testing.assert_array_equal(values_at(columns, rows), GREY[rows, columns])


def test_outside_the_edge_is_repeated() -> None:
    x, y = np.array([-5.0, 1e30, -np.inf, np.nan]), np.array([-7.0, 1e30, np.inf, 0.0])
    edge = [GREY[0, 0], GREY[59, 79], GREY[59, 0], GREY[0, 0]]
    np.testing.assert_allclose(values_at(x, y), edge, atol=0.5)


@pytest.mark.parametrize("reach", [0.0, 0.1])
def test_cells_of_a_slope_have_the_value_at_their_middle(reach: float) -> None:
    slope = (np.arange(200) + np.zeros((100, 1))).astype(np.uint8)
    H, at = np.array([[[40.0, 5, 30], [-5, 40, 20], [0, 0, 1]]]), RNG.random((7, 2))
    expected = 40 * at[:, 0] + 5 * at[:, 1] + 30
    np.testing.assert_allclose(cell_means(slope, H, at, reach)[0], expected, atol=1e-3)


def test_steps_are_outside_less_inside() -> None:
    picture = np.full((100, 100), 200, np.uint8)
    picture[30:71, 20:61] = 50
    square_px = np.array([[20, 30], [60, 30], [60, 70], [20, 70.0]])
    steps = np.empty(40)
    write_steps(picture, square_px, 2.0, new_room(80), steps)
    np.testing.assert_array_equal(steps, 150.0)
    write_steps(picture, square_px[[1, 2, 3, 0]] + np.array([5.0, 0]), 2.0, new_room(80), steps)
    np.testing.assert_array_equal(
        steps.reshape(4, 10).mean(axis=1) > 100, [False, True, False, True]
    )


def test_of_squares_in_one_place_the_first_remains() -> None:
    square = np.array([[0, 0], [40, 0], [40, 40], [0, 40.0]])
    squares = np.stack([square, square + 13, square + 25, 2 * square - 20, square + 100])
    assert first_per_place(squares).tolist() == [True, False, True, True, True]
    assert in_places(squares, squares[[0, 4]]).tolist() == [True, True, False, False, True]
    assert first_per_place(squares[:0]).tolist() == in_places(squares[:0], squares).tolist() == []
