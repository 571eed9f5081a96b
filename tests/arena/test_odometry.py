"""Odometry: exact arcs, and wheels found again with a covariance that is right."""

import numpy as np
import pytest

from tagmetry.arena.drive import Drive, Twist
from tagmetry.arena.odometry import Stretch, dead_reckoned, fit_wheels
from tagmetry.arena.place import Place
from tagmetry.errors import InputError

DRIVE = Drive(0.033, 0.14, 12.0)
PLACE_SD_M, HEADING_SD_RAD = 0.0005, 0.002


def test_twist_and_wheel_speeds_undo_each_other():
    left, right = DRIVE.wheel_speeds_radps(Twist(0.21, -0.8))
    back = DRIVE.twist(left, right)
    assert (back.speed_mps, back.turn_rate_radps) == pytest.approx((0.21, -0.8))


def test_a_wheel_on_the_spot_is_the_circle_s_centre():
    twist = DRIVE.twist(0.0, 5.0)
    assert twist.speed_mps / twist.turn_rate_radps == pytest.approx(DRIVE.track_m / 2)


def test_a_motion_too_fast_is_slowed_on_its_curve():
    wanted = Twist(1.0, 3.0)
    slowed = DRIVE.within(wanted)
    assert max(map(abs, DRIVE.wheel_speeds_radps(slowed))) == pytest.approx(12.0)
    assert slowed.turn_rate_radps / slowed.speed_mps == pytest.approx(3.0)
    assert DRIVE.within(Twist(0.1, 0.0)) == Twist(0.1, 0.0)


def test_a_driven_circle_closes():
    turns = np.tile([[2.0, 3.0]], (100, 1))
    share = 2 * np.pi / (0.033 * 100 / 0.14)  # of its one radian per reading, for one round
    *_, end = dead_reckoned(Place(1, 1, 0.3), share * turns, DRIVE)
    assert (end.x_m, end.y_m, end.heading_rad) == pytest.approx((1, 1, 0.3), abs=1e-9)


def driven(rng, wheels=(0.0335, 0.0325, 0.144), count=30, noisy=True):
    """Make stretches by small chords instead of arcs; the camera sees their ends with errors."""
    stretches = []
    for _ in range(count):
        turns = np.tile(rng.uniform(-0.02, 0.06, 2), (400, 1))
        left, right = turns.T * np.array(wheels[:2])[:, None]
        heading = np.cumsum((right - left) / wheels[2])
        middle = heading - (right - left) / wheels[2] / 2
        ahead = (left + right) / 2
        end = np.array([ahead @ np.cos(middle), ahead @ np.sin(middle), heading[-1]])
        errors = rng.normal(size=(2, 3)) * [PLACE_SD_M, PLACE_SD_M, HEADING_SD_RAD] * noisy
        start = Place(0.2, -0.4, 1.0)
        ends = (start @ Place(*errors[0]), start @ Place(*end) @ Place(*errors[1]))
        stretches.append(Stretch(*ends, turns))
    return stretches


def fitted(stretches):
    return fit_wheels(stretches, DRIVE, PLACE_SD_M, HEADING_SD_RAD)


def test_the_true_wheels_come_out():
    fit = fitted(driven(np.random.default_rng(0), noisy=False))
    wheels = (fit.left_radius_m, fit.right_radius_m, fit.track_m)
    assert wheels == pytest.approx((0.0335, 0.0325, 0.144), rel=1e-4)
    assert not fit.slipped.any()


def test_its_covariance_is_right():
    distances = []
    for seed in range(60):
        fit = fitted(driven(np.random.default_rng(seed), count=12))
        error = np.array([fit.left_radius_m, fit.right_radius_m, fit.track_m])
        error -= [0.0335, 0.0325, 0.144]
        distances.append(error @ np.linalg.solve(fit.covariance, error))
    assert np.mean(distances) == pytest.approx(3, abs=3 * np.sqrt(6 / 60))


def test_a_stretch_with_slip_is_named_and_does_little_harm():
    stretches = driven(np.random.default_rng(3))
    slipped = stretches[7]
    turned = Stretch(slipped.start, slipped.end @ Place(0, 0, 0.2), slipped.wheel_turns_rad)
    fit = fitted([*stretches[:7], turned, *stretches[8:]])
    assert np.flatnonzero(fit.slipped).tolist() == [7]
    assert fit.track_m == pytest.approx(0.144, rel=0.01)


def test_straight_stretches_alone_are_refused():
    ahead = np.full((50, 2), 0.05)
    stretch = Stretch(Place(0, 0, 0), Place(50 * 0.05 * 0.033, 0, 0), ahead)
    with pytest.raises(InputError, match="others that turn"):
        fitted([stretch] * 5)
    with pytest.raises(InputError, match="at least 3"):
        fitted([stretch] * 2)


def test_a_drive_without_wheels_is_refused():
    with pytest.raises(InputError, match="wheel_radius_m"):
        Drive(0.0, 0.1, 1.0)
