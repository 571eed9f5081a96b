"""The mean over a footprint is exact: against closed forms and against very many rays."""

import numpy as np
import pytest

from tagmetry.geometry.arrays import Array
from tagmetry.twin.rendering.coverage import footprint_means

CELLS = np.random.default_rng(0).random((7, 9))


def corners(
    size: int, scale: float, turn_rad: float, origin: tuple[float, float]
) -> tuple[Array, Array]:
    """Return the corners of size x size square pixels laid over the sheet, in cells."""
    u, v = np.meshgrid(np.arange(size + 1.0), np.arange(size + 1.0))
    cos, sin = scale * np.cos(turn_rad), scale * np.sin(turn_rad)
    return origin[0] + u * cos - v * sin, origin[1] + u * sin + v * cos


@pytest.mark.parametrize(
    ("scale", "turn_rad", "origin"),
    [
        pytest.param(0.31, 0.37, (1.0, -2.0), id="turned"),
        pytest.param(0.25, 0.0, (-1.0, -1.0), id="pixel edges on cell edges"),
        pytest.param(0.3, 0.0, (-1.0, -1.0), id="level"),
        pytest.param(0.5, np.pi / 2, (12.0, -1.0), id="a quarter turn"),
        pytest.param(3.7, 2.5, (40.0, 10.0), id="pixels larger than cells"),
    ],
)
def test_equals_the_mean_of_many_rays(
    scale: float, turn_rad: float, origin: tuple[float, float]
) -> None:
    size, rays = 40, 60
    colour, share = footprint_means(*corners(size, scale, turn_rad, origin), CELLS)
    steps = (np.arange(size * rays) + 0.5) / rays
    u, v = np.meshgrid(steps, steps)
    cos, sin = scale * np.cos(turn_rad), scale * np.sin(turn_rad)
    column = np.floor(origin[0] + u * cos - v * sin).astype(int)
    row = np.floor(origin[1] + u * sin + v * cos).astype(int)
    inside = (column >= 0) & (column < 9) & (row >= 0) & (row < 7)
    value = np.where(inside, CELLS[np.clip(row, 0, 6), np.clip(column, 0, 8)], 0.0)
    blocks = (size, rays, size, rays)
    np.testing.assert_allclose(share, inside.reshape(blocks).mean(axis=(1, 3)), atol=2e-3)
    np.testing.assert_allclose(colour, value.reshape(blocks).mean(axis=(1, 3)), atol=2e-3)


@pytest.mark.parametrize("turn_rad", [0.0, 0.1, 1.0, 2.0, 4.0])
def test_all_light_of_the_sheet_is_gathered_once(turn_rad: float) -> None:
    middle = np.array([4.5, 3.5])
    cos, sin = np.cos(turn_rad), np.sin(turn_rad)
    start = middle - 0.2 * 40 * np.array([cos - sin, sin + cos])
    colour, share = footprint_means(*corners(80, 0.2, turn_rad, (start[0], start[1])), CELLS)
    assert colour.sum() * 0.2**2 == pytest.approx(CELLS.sum(), abs=1e-10)
    assert share.sum() * 0.2**2 == pytest.approx(63.0, abs=1e-10)


def test_half_a_pixel_on_the_sheet_is_half_covered() -> None:
    x, y = np.meshgrid([-0.25, 0.25], [1.0, 1.5])
    colour, share = footprint_means(x, y, np.full((7, 9), 0.8))
    assert share[0, 0] == pytest.approx(0.5, abs=1e-15)
    assert colour[0, 0] == pytest.approx(0.4, abs=1e-15)


def test_mirrored_footprints_have_positive_shares() -> None:
    x, y = np.meshgrid([3.0, 2.0], [1.0, 2.0])
    colour, share = footprint_means(x, y, CELLS)
    assert share[0, 0] == pytest.approx(1.0)
    assert colour[0, 0] == pytest.approx(CELLS[1, 2])


def test_rays_that_miss_the_plane_see_nothing_and_spoil_no_neighbour() -> None:
    x, y = corners(4, 0.5, 0.0, (2.0, 2.0))
    x[0, 0] = np.nan
    colour, share = footprint_means(x, y, CELLS)
    assert colour[0, 0] == share[0, 0] == 0.0
    assert share.ravel()[1:] == pytest.approx(1.0)
