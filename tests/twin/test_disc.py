"""The share of a disc in every cell: against closed forms, counting, and moments."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.twin.optics.disc import disc_kernel


def counted(radius: float, per_cell: int = 201) -> np.ndarray:
    """Return the same shares by counting points in the disc."""
    reach = max(int(np.ceil(radius - 0.5)), 0)
    cells = 2 * reach + 1
    at = (np.arange(cells * per_cell) + 0.5) / per_cell - 0.5 - reach
    inside = at[:, None] ** 2 + at**2 <= radius**2
    count = inside.reshape(cells, per_cell, cells, per_cell).sum(axis=(1, 3))
    return count / count.sum()


@pytest.mark.parametrize("radius", [0.2, 0.5, 0.6, 0.71, 1.0, 1.5, 2.37, 6.1])
def test_equals_the_share_of_counted_points(radius: float) -> None:
    np.testing.assert_allclose(disc_kernel(radius), counted(radius), atol=3e-4 / radius)


def test_the_unit_disc_has_the_areas_that_geometry_gives() -> None:
    middle = 1.0
    side = np.sqrt(0.75) / 2 + np.pi / 6 - 0.5  # under the circle for |y| < 1/2, less half a cell
    corner = (np.pi - middle - 4 * side) / 4
    expected = np.array([[corner, side, corner], [side, middle, side], [corner, side, corner]])
    np.testing.assert_allclose(disc_kernel(1.0), expected / np.pi, atol=1e-15)


def test_a_disc_within_a_cell_is_that_cell() -> None:
    np.testing.assert_array_equal(disc_kernel(0.5), [[1.0]])


@given(st.floats(0.05, 90.0))
def test_is_light_that_is_neither_lost_nor_turned(radius: float) -> None:
    kernel = disc_kernel(radius)
    assert kernel.sum() == pytest.approx(1.0, abs=1e-12)
    assert kernel.min() > -1e-12
    np.testing.assert_allclose(kernel, kernel.T, atol=1e-13)
    np.testing.assert_allclose(kernel, kernel[::-1], atol=1e-13)


@pytest.mark.parametrize("radius", [2.0, 5.0, 10.0, 40.0])
def test_its_second_moment_is_the_discs_and_a_cells(radius: float) -> None:
    """On average over radii; a single one is off by how its rim lies on the grid."""
    excess = []
    for near in np.linspace(radius, radius + 1, 50):
        kernel = disc_kernel(near)
        at = np.arange(len(kernel)) - len(kernel) // 2
        excess.append(kernel.sum(axis=0) @ at**2 - near**2 / 4)
    assert np.mean(excess) == pytest.approx(1 / 12, abs=0.004)
    assert np.max(np.abs(excess)) < 1 / 12 + 0.06
