"""A second look where markers have neighbours, or where hardly anything was found."""

import numpy as np
import pytest

from tagmetry.detect.again import Box, again

SHAPE = (1080, 1920)


def squares_at(*places: tuple[float, float, float]) -> np.ndarray:
    """Upright squares by (x, y) of their middles and side, shape (n, 4, 2)."""
    unit = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    return np.array([np.array([x, y]) + side * unit for x, y, side in places]).reshape(-1, 4, 2)


LONE = squares_at((200, 200, 60), (600, 300, 60), (1400, 800, 60))


def test_it_is_looked_everywhere_where_no_marker_was_found() -> None:
    assert again(squares_at(), squares_at(), squares_at(), SHAPE) == Box(0, 0, 1920, 1080)
    assert again(squares_at(), LONE, LONE, SHAPE) == Box(0, 0, 1920, 1080)


def test_markers_that_stand_alone_are_not_looked_at_again() -> None:
    assert again(LONE, LONE, LONE, SHAPE) is None
    within = squares_at((210, 190, 15), (600, 300, 45))  # a black cell, a border's inside
    assert again(LONE, LONE, np.concatenate([LONE, within]), SHAPE) is None


def test_the_surroundings_of_neighbours_are_looked_at_again() -> None:
    beside = squares_at((260, 260, 20))
    both = np.concatenate([LONE, beside])
    box = again(LONE, both, both, SHAPE)
    assert box == Box(50, 50, 351, 351, 24.0)  # two sides around the marker, but within the image
    corner = squares_at((40, 1060, 60))
    both = np.concatenate([corner, squares_at((110, 1060, 60))])
    box = again(corner, both, both, SHAPE)
    assert box == Box(0, 910, 191, 1080, 24.0)


def test_blots_count_where_they_touch_a_markers_corner() -> None:
    beside = np.concatenate([LONE, squares_at((260, 200, 20))])  # ten pixels from its side
    assert again(LONE, LONE, beside, SHAPE) is None
    dots = np.concatenate([LONE, squares_at((239, 239, 18))])
    assert again(LONE, LONE, dots, SHAPE) == Box(50, 50, 351, 351, 24.0)


def test_neighbours_of_few_markers_are_clutter() -> None:
    many = squares_at(*((100.0 + 200 * k, 500.0, 60.0) for k in range(9)))
    beside = squares_at((170, 500, 30))
    both = np.concatenate([many, beside])
    assert again(many, both, both, SHAPE) is None


def test_it_is_looked_everywhere_where_squares_outnumber_markers() -> None:
    others = squares_at(*((100.0 + 40 * k, 900.0, 20.0) for k in range(6)))
    both = np.concatenate([LONE, others])
    assert again(LONE, both, both, SHAPE) == Box(0, 0, 1920, 1080)
    assert again(LONE, both[:-1], both, SHAPE) is None


def test_a_pattern_of_plain_squares_is_not_looked_at_again() -> None:
    many = squares_at(*((20.0 * k, 20.0 * m, 10.0) for k in range(40) for m in range(26)))
    assert again(squares_at(), squares_at(), many, SHAPE) is None
    assert again(squares_at(), many[:1], many, SHAPE) == Box(0, 0, 1920, 1080)


@pytest.mark.parametrize(("side_px", "worth"), [(15.0, True), (17.0, False)])
def test_it_is_looked_everywhere_where_markers_are_about_the_smallest(
    side_px: float, worth: bool
) -> None:
    markers = np.concatenate([LONE, squares_at((900, 900, side_px))])
    box = again(markers, markers, markers, SHAPE, least_px=8.0)
    assert box == (Box(0, 0, 1920, 1080) if worth else None)
    assert again(markers, markers, markers, SHAPE) is None  # a glance is said to see them


def test_nothing_is_looked_at_twice() -> None:
    both = np.concatenate([LONE, squares_at((260, 260, 20))])
    box = again(LONE, both, both, SHAPE)
    assert box is not None
    assert again(LONE, both, both, SHAPE, looked_at=box) is None
    assert again(LONE + 40, both + 40, both + 40, SHAPE, looked_at=box) is None  # hardly new
    assert again(LONE + 80, both + 80, both + 80, SHAPE, looked_at=box) is not None
    nothing = squares_at()
    assert again(nothing, nothing, nothing, SHAPE, looked_at=Box(0, 0, 1920, 1080)) is None


def test_a_box_cuts_its_part_out_of_an_image() -> None:
    box = Box(3, 5, 10, 20)
    image = np.zeros((30, 40))
    assert image[box.rows_and_columns].shape == (15, 7)
    assert box.holds(Box(3, 6, 9, 20))
    assert not box.holds(Box(2, 6, 9, 20))
    assert not box.holds(Box(3, 6, 9, 21))
