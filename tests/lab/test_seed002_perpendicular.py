"""Pairs that share their noise: corners are as stated, and a gain is found where there is one."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.geometry import mahalanobis_squared
from tagmetry.lab.beside.sample import sample
from tagmetry.lab.beside.seed002_perpendicular import FIVE, FOUR, conclude, gains
from tagmetry.lab.experiments.seed002_perpendicular import Case, cases, measure
from tagmetry.lab.rigs.marker_floor import CAMERA, Stand, camera_place, marker_map
from tagmetry.lab.rigs.simulated_corners import corner_covariances_px2, seen_corners
from tagmetry.lab.rows import Localization

STAND = Stand(FIVE, 3.0)


@pytest.fixture(scope="module")
def rows() -> list[Localization]:
    return list(measure(Case(5.0, 0.0, 30), 4))


def test_corners_have_the_noise_that_they_state() -> None:
    rng, markers = np.random.default_rng(0), marker_map(STAND).markers
    T = camera_place(STAND, rng)
    covariances = corner_covariances_px2(markers, T)
    assert sorted(covariances) == [0, 1, 2, 3, 4]
    true_px = CAMERA.project(np.asarray(T.inv().apply(markers[2].p_world)))
    looks = [list(seen_corners(markers, T, covariances, rng))[2] for _ in range(300)]
    errors = np.array([(one.corners_px - true_px).ravel() for one in looks])
    d2 = mahalanobis_squared(errors, looks[0].corners_cov_px2)
    assert d2.mean() == pytest.approx(8, abs=4 * np.sqrt(16 / 300))


def test_a_marker_seen_from_behind_is_not_seen() -> None:
    markers = marker_map(STAND).markers
    below = Stand(FIVE, -3.0)
    T = camera_place(below, np.random.default_rng(0))
    assert corner_covariances_px2(markers, T) == {}
    assert list(seen_corners(markers, T, {}, np.random.default_rng(0))) == []


def test_shared_markers_have_the_same_noise() -> None:
    T = camera_place(STAND, np.random.default_rng(1))
    five = marker_map(STAND).markers
    covariances = corner_covariances_px2(five, T)
    first, second = (
        list(seen_corners(markers, T, covariances, np.random.default_rng(2)))
        for markers in (five, five[:4])
    )
    for one, other in zip(first[:4], second, strict=True):
        np.testing.assert_array_equal(one.corners_px, other.corners_px)


def test_pairs_are_measured_with_right_covariances(rows: list[Localization]) -> None:
    assert [row.layout for row in rows[:4]] == [FOUR, FIVE, FOUR, FIVE]
    d2 = np.array([row.mahalanobis2 for row in rows])
    assert d2.mean() == pytest.approx(6, abs=4 * np.sqrt(12 / len(d2)))


def test_five_markers_state_a_smaller_covariance_than_four(rows: list[Localization]) -> None:
    four, five = (sample(rows).where(layout=name).values("sd_radial_m") for name in (FOUR, FIVE))
    assert np.median(five) < 0.95 * np.median(four)


def test_a_gain_is_seen_by_pairs_though_the_scatter_is_larger() -> None:
    rng, plain = np.random.default_rng(3), measure(Case(2.0, 0.0, 1), 0)[0]
    rows = []
    for n in range(200):
        error_m = rng.uniform(0, 1e-3)
        rows += [
            replace(plain, repeat=n, layout=FOUR, radial_m=error_m),
            replace(plain, repeat=n, layout=FIVE, radial_m=error_m - 2e-5 + 1e-5 * rng.normal()),
        ]
    assert gains(sample(rows), "radial_m").mean() == pytest.approx(2e-5, rel=0.1)
    check = conclude(rows).checks[0]
    assert check.holds
    assert check.measured.endswith("200 pairs")
    assert conclude([replace(row, radial_m=1e-3) for row in rows]).checks[0].holds is False


def test_the_figure_is_drawn(rows: list[Localization]) -> None:
    pytest.importorskip("matplotlib")
    (figure,) = conclude(rows).figures
    assert len(figure.draw().axes[0].get_lines()) == 2


def test_cases() -> None:
    assert {case.distance_m for case in cases(quick=True)} == {1, 2, 3, 4, 5, 6, 7}
    assert len(cases(quick=False)) > len(cases(quick=True))
