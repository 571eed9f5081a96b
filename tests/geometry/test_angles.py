"""Means of angles and rotations, above all where the circle closes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize

from tagmetry.errors import InputError
from tagmetry.geometry import mean_angle_rad, mean_rotation, wrap_angle_rad
from tagmetry.geometry.transforms import Rotation


@given(st.floats(-1e4, 1e4))
def test_a_wrapped_angle_is_the_same_direction_in_half_open_range(angle_rad: float) -> None:
    wrapped = float(wrap_angle_rad(angle_rad))
    assert -np.pi < wrapped <= np.pi
    assert np.cos(wrapped) == pytest.approx(np.cos(angle_rad), abs=1e-9)
    assert np.sin(wrapped) == pytest.approx(np.sin(angle_rad), abs=1e-9)


@pytest.mark.parametrize(
    "angle_rad",
    [np.pi, -np.pi, 3 * np.pi, np.nextafter(np.pi, 4), np.nextafter(-np.pi, -4)],
)
def test_the_seam_stays_in_range(angle_rad: float) -> None:
    wrapped = float(wrap_angle_rad(angle_rad))
    assert -np.pi < wrapped <= np.pi
    assert abs(wrapped) == pytest.approx(np.pi)


def test_wrap_keeps_the_shape() -> None:
    angles = np.array([[0.5, 2 * np.pi + 0.5], [-0.5, 7.0]])
    expected = [[0.5, 0.5], [-0.5, 7.0 - 2 * np.pi]]
    np.testing.assert_allclose(wrap_angle_rad(angles), expected)


@given(st.floats(-np.pi, np.pi), st.floats(0.01, 1.0), st.floats(0.0, 10.0))
def test_the_mean_turns_with_its_angles(center: float, half: float, turn: float) -> None:
    angles = center + half * np.array([-1.0, -0.2, 0.2, 1.0])
    found = mean_angle_rad(angles + turn)
    assert wrap_angle_rad(found - center - turn) == pytest.approx(0.0, abs=1e-9)


def test_the_mean_at_the_seam_is_not_its_opposite() -> None:
    found = mean_angle_rad(np.deg2rad([179.0, -177.0]))
    assert np.rad2deg(found) == pytest.approx(-179.0)


@pytest.mark.parametrize("mean_deg", [100.0, 170.0, -100.0, -170.0])
def test_atan_as_printed_in_seed_002_would_be_half_a_turn_wrong(mean_deg: float) -> None:
    angles = np.deg2rad([mean_deg - 5, mean_deg + 5])
    printed = np.arctan(np.sin(angles).sum() / np.cos(angles).sum())
    assert np.rad2deg(mean_angle_rad(angles)) == pytest.approx(mean_deg)
    assert abs(np.rad2deg(printed) - mean_deg) == pytest.approx(180.0)


def test_weights_stand_in_both_sums() -> None:
    found = mean_angle_rad(np.array([0.0, np.pi / 2]), np.array([3.0, 1.0]))
    assert found == pytest.approx(np.arctan2(1.0, 3.0))


def test_a_weight_counts_like_repetition() -> None:
    once = mean_angle_rad(np.array([0.1, 2.0, 2.0, 2.0]))
    weighted = mean_angle_rad(np.array([0.1, 2.0]), np.array([1.0, 3.0]))
    assert weighted == pytest.approx(once)


@pytest.mark.parametrize("angles", [[0.3, 0.3 + np.pi], np.arange(4) * np.pi / 2])
def test_directions_that_cancel_have_no_mean(angles: list[float]) -> None:
    assert np.isnan(mean_angle_rad(np.array(angles)))


def test_mean_rotation_is_what_a_brute_minimisation_finds() -> None:
    rng = np.random.default_rng(3)
    rotations = Rotation.random(rng=rng) * Rotation.from_rotvec(rng.normal(scale=0.7, size=(6, 3)))
    weights = rng.uniform(0.1, 3.0, 6)

    def cost(rotvec: np.ndarray) -> float:
        apart = rotations.as_matrix() - Rotation.from_rotvec(rotvec).as_matrix()
        return float(weights @ (apart**2).sum(axis=(1, 2)))

    starts = Rotation.random(8, rng=rng).as_rotvec()
    found = min((minimize(cost, start, tol=1e-12) for start in starts), key=lambda r: r.fun)
    apart = Rotation.from_rotvec(found.x) * mean_rotation(rotations, weights).inv()
    assert apart.magnitude() < 1e-4


def test_mean_rotation_without_weights_weighs_equally() -> None:
    rotations = Rotation.from_rotvec([[0, 0, 0.2], [0, 0, 0.6], [0, 0, 0.4]])
    np.testing.assert_allclose(mean_rotation(rotations).as_rotvec(), [0, 0, 0.4], atol=1e-12)


@pytest.mark.parametrize("weights", [[-1.0, 2.0], [0.0, 0.0], [np.nan, 1.0], [np.inf, 1.0]])
def test_refuses_weights_that_weigh_nothing(weights: list[float]) -> None:
    with pytest.raises(InputError, match="finite, not negative, and not all zero"):
        mean_angle_rad(np.array([0.0, 1.0]), np.array(weights))


def test_refuses_another_number_of_weights() -> None:
    with pytest.raises(InputError, match=r"expected 2 weights, got an array of shape \(3,\)"):
        mean_rotation(Rotation.identity(2), np.ones(3))


def test_refuses_a_mean_of_nothing() -> None:
    with pytest.raises(InputError, match="at least one value"):
        mean_angle_rad(np.array([]))
