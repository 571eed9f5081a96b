"""The delay that is found is the one that there is, and its deviation tells how well it is."""

import numpy as np
import pytest
from scipy.stats import chi2

from tagmetry.arena.latency import (
    Expected,
    estimate_reaction,
    expected_heading,
    expected_light,
)
from tagmetry.arena.wiggle import wiggle
from tagmetry.errors import InputError
from tagmetry.geometry import Array

STEP_S = 1e-4


def turned(times_s: Array, rates: Array, at_s: Array, delay_s: float, lag_s: float = 0.0) -> Array:
    """Integrate a robot in tiny steps: a dead time, then a motor that follows with a lag."""
    grid_s = np.arange(0.0, at_s.max() + STEP_S, STEP_S)
    held = np.searchsorted(times_s, grid_s - delay_s, side="right") - 1
    wanted = np.where(held >= 0, rates[np.maximum(held, 0)], 0.0)
    rate, heading, way = 0.0, 0.0, np.empty_like(grid_s)
    for n, target in enumerate(wanted):
        way[n] = heading
        rate = target if lag_s == 0 else rate + (target - rate) * STEP_S / lag_s
        heading += rate * STEP_S
    return np.interp(at_s, grid_s, way)


def image_times(rng: np.random.Generator, end_s: float, rate_hz: float = 30.0) -> Array:
    return np.arange(0.01, end_s, 1 / rate_hz) + rng.uniform(-0.004, 0.004)


@pytest.mark.parametrize("delay_s", [0.0, 0.0123, 0.05, 0.1, 0.487])
def test_finds_a_dead_time_far_finer_than_the_images(delay_s: float) -> None:
    rng = np.random.default_rng(1)
    times_s, rates = wiggle(rng)
    at_s = image_times(rng, times_s[-1] + 0.5)
    seen = 0.7 + 0.9 * turned(times_s, rates, at_s, delay_s)
    found = estimate_reaction(expected_heading(times_s, rates), at_s, seen)
    assert found.why_not == ""
    assert found.delay_s == pytest.approx(delay_s, abs=2e-4)
    assert found.gain == pytest.approx(0.9, abs=1e-3)


def test_its_deviation_covers_the_error() -> None:
    rng = np.random.default_rng(2)
    times_s, rates = wiggle(rng, count=6)
    expected = expected_heading(times_s, rates)
    squares = []
    for _ in range(200):
        delay_s = rng.uniform(0.02, 0.2)
        at_s = image_times(rng, times_s[-1] + 0.3)
        seen = expected.at(at_s - delay_s) + rng.normal(0, 0.01, len(at_s))
        found = estimate_reaction(expected, at_s, seen, longest_s=0.4)
        squares.append(((found.delay_s - delay_s) / found.sd_s) ** 2)
        assert found.noise == pytest.approx(0.01, rel=0.35)
    low, high = chi2.ppf([0.001, 0.999], len(squares)) / len(squares)
    assert low < np.mean(squares) < high


def test_a_motor_s_lag_is_part_of_the_delay() -> None:
    rng = np.random.default_rng(3)
    times_s, rates = wiggle(rng, shortest_s=0.5)
    at_s = image_times(rng, times_s[-1] + 0.5)
    seen = turned(times_s, rates, at_s, 0.06, lag_s=0.04)
    found = estimate_reaction(expected_heading(times_s, rates), at_s, seen)
    assert found.delay_s == pytest.approx(0.10, abs=0.006)


def test_headings_may_jump_by_a_turn_and_turn_the_other_way() -> None:
    rng = np.random.default_rng(4)
    times_s, rates = wiggle(rng)
    at_s = image_times(rng, times_s[-1] + 0.5)
    seen = np.angle(np.exp(1j * (3.1 - turned(times_s, rates, at_s, 0.08))))
    found = estimate_reaction(expected_heading(times_s, rates), at_s, seen)
    assert found.delay_s == pytest.approx(0.08, abs=2e-4)
    assert found.gain == pytest.approx(-1.0, abs=1e-3)


def test_a_lamp_s_delay_is_finer_than_the_images() -> None:
    rng = np.random.default_rng(5)
    switched_s = np.cumsum(rng.uniform(0.1, 0.3, 40))
    is_lit = np.arange(40) % 2 == 0
    at_s = image_times(rng, switched_s[-1] + 0.3)
    exposure_s, delay_s = 0.008, 0.0437
    within_s = np.linspace(-exposure_s / 2, exposure_s / 2, 801)
    held = np.searchsorted(switched_s, at_s[:, None] + within_s - delay_s, side="right") - 1
    light = np.where(held >= 0, is_lit[np.maximum(held, 0)], False).mean(axis=1)
    seen = 20 + 180 * light + rng.normal(0, 1, len(at_s))
    expected = expected_light(switched_s, is_lit, exposure_s)
    found = estimate_reaction(expected, at_s, seen)
    assert found.delay_s == pytest.approx(delay_s, abs=4 * found.sd_s)
    assert found.sd_s < 1e-4


def test_what_is_expected_is_the_integral() -> None:
    found = expected_heading(np.array([1.0, 2.0, 4.0]), np.array([1.0, -0.5, 2.0]))
    at_s = np.array([0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0])
    np.testing.assert_allclose(found.at(at_s), [0, 0, 0.5, 1, 0.5, 0, 2])
    np.testing.assert_allclose(found.slope_at(at_s + 1e-9), [0, 1, 1, -0.5, -0.5, 2, 2])


def test_the_light_of_an_exposure_is_a_ramp() -> None:
    found = expected_light(np.array([1.0, 2.0]), np.array([1, 0]), 0.2)
    at_s = np.array([0.0, 0.9, 1.0, 1.05, 1.1, 1.5, 2.0, 2.2])
    np.testing.assert_allclose(found.at(at_s), [0, 0, 0.5, 0.75, 1, 1, 0.5, 0], atol=1e-12)


def test_a_wiggle_ends_where_it_began() -> None:
    times_s, rates = wiggle(np.random.default_rng(6), 2.0, 7, 0.1)
    assert len(times_s) == len(rates) == 15
    np.testing.assert_allclose(expected_heading(times_s, rates).values[-1], 0.0, atol=1e-12)
    assert set(np.abs(rates)) == {0.0, 2.0}
    assert np.diff(times_s).min() >= 0.1


@pytest.mark.parametrize("sort", ["still", "noise", "too late"])
def test_where_there_is_no_answer_it_says_why(sort: str) -> None:
    rng = np.random.default_rng(7)
    times_s, rates = wiggle(rng)
    at_s = image_times(rng, times_s[-1] + 0.5)
    seen = {
        "still": np.zeros(len(at_s)),
        "noise": rng.normal(0, 0.1, len(at_s)),
        "too late": np.where(at_s < 1.0, 0.0, turned(times_s, rates, at_s, 0.9)),
    }[sort]
    found = estimate_reaction(expected_heading(times_s, rates), at_s, seen, longest_s=0.3)
    assert np.isnan(found.delay_s)
    assert found.why_not


def test_refusals() -> None:
    expected = Expected(np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    many = np.arange(20.0)
    with pytest.raises(InputError, match="at least 10 images, got 9"):
        estimate_reaction(expected, many[:9], many[:9])
    with pytest.raises(InputError, match="images as two lists of one length"):
        estimate_reaction(expected, many, many[:9])
    with pytest.raises(InputError, match="finite numbers of images"):
        estimate_reaction(expected, many, np.full(20, np.nan))
    with pytest.raises(InputError, match="times of images to rise"):
        estimate_reaction(expected, many[::-1], many)
    with pytest.raises(InputError, match="a longest delay above 0 s"):
        estimate_reaction(expected, many, many, longest_s=0.0)
    with pytest.raises(InputError, match="commands as two lists"):
        expected_heading(np.array([]), np.array([]))
    with pytest.raises(InputError, match="shorter than between switchings"):
        expected_light(many, many % 2, 1.0)
    with pytest.raises(InputError, match="a count and an interval above 0"):
        wiggle(np.random.default_rng(0), count=0)
