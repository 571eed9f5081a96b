"""What stands beside markers, against the plain definition, with all distances at once."""

import numpy as np

from tagmetry.detect.again.neighbours import crowded, unread

RNG = np.random.default_rng(2)


def squares(count: int) -> np.ndarray:
    """Turned squares of 20 to 80 px, close to each other, shape (n, 4, 2)."""
    angle = RNG.uniform(0, 2 * np.pi, count)[:, None] + np.pi / 2 * np.arange(4)
    half = RNG.uniform(14, 56, count)[:, None, None]
    middle = RNG.uniform(0, 900, (count, 1, 2))
    return middle + half * np.stack([np.cos(angle), np.sin(angle)], axis=2)


def apart_and_ratio(markers: np.ndarray, others: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distances from centre to centre and sides, by the marker's side, shape (m, n)."""
    sides = [
        np.linalg.norm(s - np.roll(s, 1, axis=1), axis=2).mean(axis=1) for s in (markers, others)
    ]
    apart = np.linalg.norm(others.mean(axis=1) - markers.mean(axis=1)[:, None], axis=2)
    return apart / sides[0][:, None], sides[1] / sides[0][:, None]


def test_pictures_count_as_unread_where_no_marker_is() -> None:
    markers, pictures = squares(30), squares(60)
    apart, _ = apart_and_ratio(markers, pictures)
    expected = int((apart > 0.75).all(axis=0).sum())
    assert 0 < expected < 60
    assert unread(markers, pictures) == expected
    assert unread(markers[:0], pictures) == 60
    assert unread(markers, pictures[:0]) == 0


def test_markers_are_crowded_by_pictures_beside_them() -> None:
    markers, pictures = squares(30), squares(20)
    apart, ratio = apart_and_ratio(markers, pictures)
    expected = ((apart > 0.75) & (apart < 1.6) & (ratio > 0.2) & (ratio < 2.5)).any(axis=1)
    assert 0 < expected.sum() < 30
    np.testing.assert_array_equal(crowded(markers, pictures, squares(0)), expected)


def test_markers_are_crowded_by_squares_at_their_corners() -> None:
    markers, others = squares(30), squares(60)
    apart, ratio = apart_and_ratio(markers, others)
    gaps = markers[:, None, :, None] - others[None, :, None]
    between = np.linalg.norm(gaps, axis=4).min(axis=(2, 3))
    side = np.linalg.norm(markers - np.roll(markers, 1, axis=1), axis=2).mean(axis=1)
    touching = (between < 0.15 * side[:, None]) & (apart > 0.6) & (apart < 1.6) & (ratio > 0.2)
    expected = touching.any(axis=1)
    assert 0 < expected.sum() < 30
    np.testing.assert_array_equal(crowded(markers, squares(0), others), expected)
