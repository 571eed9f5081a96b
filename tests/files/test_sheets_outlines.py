"""Outlines of cells: they enclose just the filled ones."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tagmetry.files.sheets.outline import outlines_m
from tagmetry.files.sheets.page import Box, Cells


@settings(max_examples=80, deadline=None)
@given(st.integers(1, 9), st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_outlines_enclose_just_the_filled_cells(rows: int, columns: int, seed: int) -> None:
    filled = np.random.default_rng(seed).random((rows, columns)) < 0.5
    loops = outlines_m(Cells(Box(0.0, 0.0, columns, rows), filled))
    area = sum(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2 for x, y in (p.T for p in loops))
    assert area == filled.sum()
    inside = np.zeros_like(filled)
    for row, column in np.ndindex(rows, columns):
        crossings = [crossed(loop, column + 0.5, row + 0.5) for loop in loops]
        inside[row, column] = sum(crossings) % 2
    np.testing.assert_array_equal(inside, filled)


def crossed(loop: np.ndarray, x: float, y: float) -> int:
    """How many sides of the loop a ray to the right of the point crosses."""
    ends = np.roll(loop, -1, axis=0)
    spans = (np.minimum(loop, ends)[:, 1] < y) & (np.maximum(loop, ends)[:, 1] > y)
    return int((spans & (loop[:, 0] > x)).sum())


def test_a_solid_block_has_one_outline_of_four_corners() -> None:
    (loop,) = outlines_m(Cells(Box(1.0, 2.0, 3.0, 4.0), np.ones((7, 5), dtype=bool)))
    assert {tuple(corner) for corner in loop.tolist()} == {(1, 2), (4, 2), (4, 6), (1, 6)}
