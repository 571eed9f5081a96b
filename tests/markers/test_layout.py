"""Turns of a layout form a group, with bits inside the border and outside it."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.markers import Layout

# Like standard41h12: a white border of one cell on a black surround, bits within it and in a ring
# around it.
INNER = tuple((c, r) for r in range(1, 4) for c in range(1, 4))
RING = tuple((c, r) for r in range(-2, 7) for c in range(-2, 7) if c in (-2, 6) or r in (-2, 6))
OUTSIDE = Layout(5, 1, INNER + RING, white_border=True)
LAYOUTS = {
    "4": Layout.square(4),
    "5, border 2": Layout.square(5, 2),
    "ring": OUTSIDE,
    "shuffled": Layout(6, 1, tuple(reversed(Layout.square(4).bit_cells))),
}
every_layout = pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)


def a_code(layout: Layout) -> np.ndarray:
    return np.random.default_rng(layout.bit_count).random(layout.bit_count) < 0.5


@every_layout
@pytest.mark.parametrize("k", range(4))
def test_a_turned_code_is_the_turned_picture(layout: Layout, k: int) -> None:
    code = a_code(layout)
    turned = np.rot90(layout.picture(code), -k)
    np.testing.assert_array_equal(layout.picture(code[layout.rotations[k]]), turned)


@every_layout
def test_turns_are_a_group_of_four(layout: Layout) -> None:
    np.testing.assert_array_equal(layout.rotations[0], np.arange(layout.bit_count))
    for j in range(4):
        for k in range(4):
            both = layout.rotations[j][layout.rotations[k]]
            np.testing.assert_array_equal(both, layout.rotations[(j + k) % 4])


@every_layout
def test_the_picture_shows_every_bit_at_its_centre(layout: Layout) -> None:
    code = a_code(layout)
    picture = layout.picture(code)
    cells = np.floor(layout.bit_centres * layout.side_cells).astype(int) + layout.margin_cells
    np.testing.assert_array_equal(picture[cells[:, 1], cells[:, 0]], code)
    np.testing.assert_allclose(layout.bit_centres.mean(axis=0), 0.5)


def test_a_square_layout_reads_rows_from_the_top_left() -> None:
    layout = Layout.square(3)
    assert layout.side_cells == 5
    assert layout.bit_cells[:4] == ((1, 1), (2, 1), (3, 1), (1, 2))
    np.testing.assert_allclose(layout.bit_centres[0], [0.3, 0.3])


@pytest.mark.parametrize("border", [1, 2, 3])
def test_a_square_layout_has_a_black_border(border: int) -> None:
    layout = Layout.square(4, border)
    picture = layout.picture(np.ones(16, dtype=bool))
    assert picture.shape == (4 + 2 * border,) * 2
    assert picture[border:-border, border:-border].all()
    assert picture.sum() == 16
    assert layout.margin_cells == 0


def test_bits_outside_the_square_make_a_margin() -> None:
    assert OUTSIDE.margin_cells == 2
    picture = OUTSIDE.picture(np.zeros(OUTSIDE.bit_count, dtype=bool))
    expected = np.zeros((9, 9), bool)
    expected[2:7, 2:7] = True
    expected[3:6, 3:6] = False
    np.testing.assert_array_equal(picture, expected)


def test_a_black_border_has_a_white_surround() -> None:
    layout = Layout(5, 1, INNER + RING)
    picture = layout.picture(np.zeros(layout.bit_count, dtype=bool))
    assert picture[1, 1:8].all()
    assert not picture[2, 2:7].any()


@pytest.mark.parametrize("border", [0, -1])
def test_refuses_a_border_of_no_cell(border: int) -> None:
    with pytest.raises(InputError, match=f"at least 1 cell wide, got {border}"):
        Layout.square(4, border)


@pytest.mark.parametrize("cells", [(), ((1, 1),), ((1, 1), (3, 3)), ((2, 2), (2, 2))])
def test_refuses_bits_that_do_not_turn_into_bits(cells: tuple[tuple[int, int], ...]) -> None:
    with pytest.raises(InputError, match="every bit must turn into another by a quarter"):
        Layout(5, 1, cells)
