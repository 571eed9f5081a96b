"""A second look where markers have neighbours, or where hardly anything was found."""

import numpy as np

from tagmetry.detect.again import Box, again

SHAPE = (1080, 1920)


def squares_at(*places: tuple[float, float, float]) -> np.ndarray:
    """Upright squares by (x, y) of their middles and side, shape (n, 4, 2)."""
    unit = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    return np.array([np.array([x, y]) + side * unit for x, y, side in places]).reshape(-1, 4, 2)


LONE = squares_at((200, 200, 60), (600, 300, 60), (1400, 800, 60))


def test_it_is_looked_everywhere_where_no_marker_was_found() -> None:
    assert again(squares_at(), squares_at(), SHAPE) == Box(0, 0, 1920, 1080)
    assert again(squares_at(), LONE, SHAPE) == Box(0, 0, 1920, 1080)


def test_markers_that_stand_alone_are_not_looked_at_again() -> None:
    assert again(LONE, LONE, SHAPE) is None
    within = squares_at((210, 190, 15), (600, 300, 45))  # a black cell, a border's inside
    assert again(LONE, np.concatenate([LONE, within]), SHAPE) is None


def test_the_surroundings_of_neighbours_are_looked_at_again() -> None:
    beside = squares_at((260, 260, 20))
    box = again(LONE, np.concatenate([LONE, beside]), SHAPE)
    assert box == Box(50, 50, 351, 351)  # two sides around the marker, but within the image
    corner = squares_at((40, 1060, 60))
    box = again(corner, np.concatenate([corner, squares_at((110, 1060, 60))]), SHAPE)
    assert box == Box(0, 910, 191, 1080)


def test_neighbours_of_few_markers_are_clutter() -> None:
    many = squares_at(*((100.0 + 200 * k, 500.0, 60.0) for k in range(9)))
    beside = squares_at((170, 500, 30))
    assert again(many, np.concatenate([many, beside]), SHAPE) is None


def test_it_is_looked_everywhere_where_squares_outnumber_markers() -> None:
    others = squares_at(*((100.0 + 40 * k, 900.0, 20.0) for k in range(6)))
    assert again(LONE, np.concatenate([LONE, others]), SHAPE) == Box(0, 0, 1920, 1080)
    assert again(LONE, np.concatenate([LONE, others[:5]]), SHAPE) is None


def test_a_box_cuts_its_part_out_of_an_image() -> None:
    box = Box(3, 5, 10, 20)
    image = np.zeros((30, 40))
    assert image[box.rows_and_columns].shape == (15, 7)
    assert box.holds(Box(3, 6, 9, 20))
    assert not box.holds(Box(2, 6, 9, 20))
    assert not box.holds(Box(3, 6, 9, 21))
