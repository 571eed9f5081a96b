"""A track that is seen holds what both told, as information adds up; others stay as they were."""

import numpy as np
import pytest

from tagmetry.arena.tracks.table import TrackTable

_SEES = np.eye(3, 5)  # (x, y, heading) of the five


def random_covariances(rng: np.random.Generator, count: int, size: int) -> np.ndarray:
    roots = rng.standard_normal((count, size, size))
    return np.asarray(roots @ roots.mT + 0.1 * np.eye(size))


@pytest.fixture(name="table")
def _table() -> TrackTable:
    rng = np.random.default_rng(0)
    return TrackTable(
        rng.uniform(-1, 1, (4, 5)), random_covariances(rng, 4, 5), np.zeros((4, 3, 3)), np.zeros(4)
    )


def test_information_of_track_and_sighting_adds_up(table: TrackTable) -> None:
    rng, rows = np.random.default_rng(1), np.array([2, 0])
    places, noise = rng.uniform(-1, 1, (2, 3)), random_covariances(rng, 2, 3)
    after = table.updated(rows, places, noise, np.zeros((2, 3, 3)), 1.0)
    for k, row in enumerate(rows):
        told = _SEES.T @ np.linalg.inv(noise[k])
        known = np.linalg.inv(table.covariances[row])
        covariance = np.linalg.inv(known + told @ _SEES)
        mean = covariance @ (known @ table.means[row] + told @ places[k])
        np.testing.assert_allclose(after.covariances[row], covariance, atol=1e-12)
        np.testing.assert_allclose(after.means[row], mean, atol=1e-12)
    np.testing.assert_array_equal(after.means[[1, 3]], table.means[[1, 3]])
    np.testing.assert_array_equal(after.covariances[[1, 3]], table.covariances[[1, 3]])


def test_a_table_is_never_changed(table: TrackTable) -> None:
    before = table.means.copy(), table.covariances.copy()
    rows, noise = np.array([1]), 0.1 * np.eye(3)[None]
    table.updated(rows, np.zeros((1, 3)), noise, noise, 1.0)
    np.testing.assert_array_equal(table.means, before[0])
    np.testing.assert_array_equal(table.covariances, before[1])


def test_distances_are_those_of_both_covariances(table: TrackTable) -> None:
    rows, places = np.array([3, 3]), np.array([[0.5, 0.5, 3.0], [0.5, 0.5, 3.0 - 2 * np.pi]])
    noise = random_covariances(np.random.default_rng(2), 1, 3)[[0, 0]]
    off = places[0] - table.means[3, :3]
    off[2] = np.arctan2(np.sin(off[2]), np.cos(off[2]))
    expected = off @ np.linalg.inv(table.covariances[3][:3, :3] + noise[0]) @ off
    np.testing.assert_allclose(table.distances2(rows, places, noise), expected)


def test_what_is_no_covariance_fits_nothing_and_changes_nothing(table: TrackTable) -> None:
    rows, broken = np.array([1]), np.full((1, 3, 3), np.nan)
    assert np.isinf(table.distances2(rows, np.zeros((1, 3)), broken)).all()
    after = table.updated(rows, np.zeros((1, 3)), broken, np.zeros((1, 3, 3)), 1.0)
    np.testing.assert_array_equal(after.means, table.means)
