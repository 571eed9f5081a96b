"""The stability report against the controller itself, driven through a delayed equation."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from delayed_world import STEP_S, DelayedWorld, swing

from tagmetry.arena.controllers import Arc, Course, Spring
from tagmetry.arena.place import Place
from tagmetry.arena.stability import (
    FollowingSetting,
    Loop,
    ideal_gaps_m,
    stability,
    stability_by_delay,
)
from tagmetry.arena.stability.across import Across, _Seen
from tagmetry.arena.stability.along import PLACE, Along
from tagmetry.arena.stability.loop import Margins
from tagmetry.arena.stability.wheels import Lateness, Wheels
from tagmetry.errors import InputError

AHEAD, ASIDE = Place(0.004, 0.0, 0.0), Place(0.0, 0.004, 0.0)


def setting(delay_s=0.05, **more):
    return FollowingSetting(delay_s=delay_s, image_s=0.03, **more)


@cache
def told(delay_s, hold_s=None):
    return stability(setting(delay_s, hold_s=hold_s))


def growth(world, values, since_s):
    """Return the swing of two seconds over that of the two before."""
    kept = getattr(world.run(since_s + 4.0), values)
    return swing(kept, since_s + 2, since_s + 4) / swing(kept, since_s, since_s + 2)


@pytest.mark.parametrize(("delay_s", "hold_s"), [(0.05, None), (0.1, None), (0.1, 0.2)])
@pytest.mark.parametrize(
    ("part", "values", "start"), [("along", "gaps_m", AHEAD), ("across", "aside_m", ASIDE)]
)
def test_a_delay_beyond_the_margin_swings_up_and_one_below_it_decays(
    delay_s, hold_s, part, values, start
):
    edge_s = getattr(told(delay_s, hold_s), part).delay_s
    for share, swings_up in ((0.9, False), (1.1, True)):
        late_s = (share * edge_s, 0.0) if part == "along" else (0.0, share * edge_s)
        world = DelayedWorld(delay_s, late_s, start=start, hold_s=hold_s or float("inf"))
        grown = growth(world, values, 4.0)
        assert grown > 1.15 if swings_up else grown < 0.87


@pytest.mark.parametrize(
    ("part", "values", "start"), [("along", "gaps_m", AHEAD), ("across", "aside_m", ASIDE)]
)
def test_wheels_that_answer_more_than_the_margin_swing_up(part, values, start):
    edge = getattr(told(0.1), part).gain
    for share, swings_up in ((0.95, False), (1.05, True)):
        gains = (share * edge, 1.0) if part == "along" else (1.0, share * edge)
        grown = growth(DelayedWorld(0.1, gains=gains, start=start), values, 2.0)
        assert grown > 1.2 if swings_up else grown < 0.8


@pytest.mark.parametrize("kind", [Along, Across])
def test_margins_are_those_of_the_open_loop_s_frequency_response(kind):
    """Nyquist: where the response has the length 1, how far it is from -1, and where it is real."""
    loop, image_s = Loop.of(kind(setting(0.1))), 0.03
    found = told(0.1).along if kind is Along else told(0.1).across
    omega = np.linspace(0.05, np.pi / image_s, 8000)
    z = np.exp(1j * omega * image_s)[:, None, None]
    answered = np.linalg.solve(z * np.eye(len(loop.own)) - loop.own, loop.push[:, None])
    response = -(answered[..., 0] @ loop.answer)
    crossing = np.flatnonzero(np.diff(np.sign(np.abs(response) - 1)))
    off_rad = np.abs(np.angle(-response[crossing]))
    assert found.phase_rad == pytest.approx(off_rad.min(), abs=0.02)
    later_s = (np.angle(-response[crossing]) % (2 * np.pi)) / omega[crossing]
    assert found.delay_s == pytest.approx(later_s.min(), rel=0.05)
    real = np.flatnonzero((np.diff(np.sign(response.imag)) != 0) & (response.real[:-1] < 0))
    beyond = np.abs(response.real[real])
    assert found.gain == pytest.approx(1 / beyond[beyond < 1].max(), rel=0.02)


def test_the_controller_itself_overshoots_a_longer_spring_as_told():
    world = DelayedWorld(0.1, speed_mps=0.0).run(1.0)
    world.follower._spring = replace(Spring(), length_m=0.21)
    after = np.array(world.run(5.0).gaps_m[round(1 / STEP_S) :])
    assert (after.max() - 0.21) / 0.01 == pytest.approx(told(0.1).overshoot, abs=0.015)
    assert after[-1] == pytest.approx(0.21, abs=1e-4)


def test_noise_moves_the_controller_itself_as_much_as_told():
    sd_m = 2e-4
    world = DelayedWorld(0.05, noise_m=np.sqrt(2) * sd_m).run(90.0)
    measured_m = np.std(world.gaps_m[round(5 / STEP_S) :])
    assert stability(setting(), sd_m).gap_sd_m == pytest.approx(measured_m, rel=0.1)


@pytest.mark.parametrize("hold_s", [None, 0.2])
def test_on_a_straight_line_the_ideal_drive_is_the_linear_loop(hold_s):
    """Places from where the leader starts; the loop begins with its leader known and at rest."""
    one = setting(0.07, untold_s=0.015, hold_s=hold_s)
    course = Course(Place(0.0, 0.0, 0.0), (Arc(0.6),), start_s=1.0)
    gaps_m = ideal_gaps_m(one, course)
    loop = Loop.of(Along(one))
    state = np.zeros(len(loop.own))
    state[PLACE], state[-3] = -0.2, 0.2
    for n, gap_m in enumerate(gaps_m):
        leader_m = course.at(n * one.image_s).place.x_m
        assert gap_m == pytest.approx(leader_m - state[PLACE], abs=1e-9)
        state = loop.closed() @ state + loop.driven() @ [leader_m, 0.2]


def test_small_offsets_move_as_places_do():
    small = Place(0.2, 2e-6, 3e-6)
    seen = _Seen(0.2, 2e-6, 3e-6, 4e-5)
    passed = small.seen_from(Place(0.0, 0.0, 0.0).moved(0.05, 1e-5))
    off = seen.passed(0.05, 1e-5)
    assert (off.ahead_m, off.offset, off.heading) == pytest.approx(
        (passed.x_m, passed.y_m, passed.heading_rad), abs=1e-9
    )
    carried = small.moved(0.3 * 0.5, 4e-5 * 0.5)
    off = seen.carried(0.3, 0.5)
    assert (off.ahead_m, off.offset, off.heading) == pytest.approx(
        (carried.x_m, carried.y_m, carried.heading_rad), abs=1e-9
    )


def test_a_controller_that_knows_its_delay_bears_it():
    """With a perfect predictor only the leader's surprises grow; an untold delay is worse."""
    nearest = [one.nearest_m for one in stability_by_delay(setting(), [0.0, 0.05, 0.1, 0.2])]
    assert all(np.diff(nearest) < 0)
    assert stability(setting(0.05, untold_s=0.03)).overshoot > 2 * told(0.05).overshoot
    assert not stability(setting(0.05, untold_s=0.07)).is_stable


def test_what_is_left_between_the_bodies():
    report = stability(setting(0.1), 3e-3, 0.15)
    assert report.air_m == pytest.approx(report.nearest_m - 0.15 - 3 * report.gap_sd_m)
    assert report.worst_m > 0.2 - report.nearest_m
    slow = stability(setting(0.1, speed_mps=0.1), 3e-3, 0.15)
    assert slow.air_m > report.air_m


def test_an_unstable_loop_says_so():
    report = stability(replace(setting(), spring=Spring(stiffness_per_s=60.0)))
    assert not report.is_stable
    assert report.along == Margins(1.0, 0.0, 0.0)
    assert report.overshoot == float("inf")
    assert report.air_m < 0


def test_wheels_follow_a_command_as_a_lag_does():
    wheels = Wheels.of(np.array([[0.0, 1.0]]), 0.05, None)
    place, speed = wheels.held(0.08).after(np.zeros((2, 1)), np.array([0.3]))[:, 0]
    left = np.exp(-0.08 / 0.05)
    assert speed == pytest.approx(0.3 * (1 - left))
    assert place == pytest.approx(0.3 * (0.08 - 0.05 * (1 - left)))


def test_an_integral_makes_wheels_overshoot():
    """T = 50 ms and K = 4 T: a step becomes 1 - (1 - t / 2T) exp(-t / 2T)."""
    wheels = Wheels.of(np.array([[0.0, 1.0]]), 0.05, 0.2)
    for time_s in (0.05, 0.2, 0.4):
        speed = wheels.held(time_s).after(np.zeros((3, 1)), np.array([1.0]))[1, 0]
        assert speed == pytest.approx(1 - (1 - time_s / 0.1) * np.exp(-time_s / 0.1))


@pytest.mark.parametrize(("delay_s", "whole", "rest_s"), [(0, 0, 0), (0.06, 2, 0), (0.07, 2, 0.01)])
def test_a_delay_in_images(delay_s, whole, rest_s):
    late = Lateness.of(delay_s, 0.03)
    assert (late.whole, late.rest_s) == (whole, pytest.approx(rest_s, abs=1e-12))


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: setting(-0.1), "delay_s must be 0 to 2, got"),
        (lambda: setting(float("nan")), "delay_s must be 0 to 2, got"),
        (lambda: FollowingSetting(image_s=0.0), "image_s must be 0.004 to 1, got"),
        (lambda: FollowingSetting(place_share=1.5), "place_share must be 0.001 to 1, got"),
        (
            lambda: stability(FollowingSetting(delay_s=2.0, image_s=0.01)),
            "at most 100 images, got 200",
        ),
        (lambda: setting(hold_s=0.0), "hold_s must be 0.001 to 100, got"),
        (lambda: FollowingSetting(Spring(damping=0.0)), "spring's damping must be above 0"),
        (lambda: stability(setting(), diameter_m=0.2), "touch at a distance of 0.2 m"),
        (lambda: stability(setting(), place_sd_m=float("nan")), "place_sd_m must be 0 to 1 m"),
    ],
)
def test_what_it_refuses(call, told):
    with pytest.raises(InputError, match=told):
        call()
