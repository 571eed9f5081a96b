"""Ways through points: they pass where they shall, corners are round, and robots keep to them."""

from collections.abc import Callable
from itertools import pairwise
from math import inf, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tagmetry.arena.controllers import Course, PatientFollower, View, legs_through
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place

Points = list[tuple[float, float]]
L_SHAPE: Points = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.6)]
BACK: Points = [(0.0, 0.0), (0.8, 0.0), (0.1, 0.02)]
STEP_S = 1 / 30


def sampled(legs: tuple[Course, ...]) -> np.ndarray:
    """Return places along all legs, shape (n, 2)."""
    moments = [(leg, t) for leg in legs for t in np.linspace(leg.start_s, leg.end_s, 200)]
    return np.array([leg.at(float(t)).place.xy_m for leg, t in moments])


def off_m(places: np.ndarray, points: Points) -> np.ndarray:
    """Return how far places are from straight lines between points, shape (n,)."""
    nearest = np.full(len(places), inf)
    for start, end in zip(np.array(points[:-1]), np.array(points[1:]), strict=True):
        along = end - start
        share = np.clip((places - start) @ along / max(along @ along, 1e-12), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(places - start - share[:, None] * along).T))
    return nearest


def test_a_right_angle_is_cut_by_the_arc_that_touches_both_sides() -> None:
    (leg,) = legs_through(L_SHAPE, radius_m=0.2)
    assert leg.length_m == pytest.approx(1.6 - 2 * 0.2 + pi / 2 * 0.2)
    middle = np.array([1.0, 0.0]) + 0.2 * (np.sqrt(2) - 1) / np.sqrt(2) * np.array([-1, 1])
    assert np.hypot(*(sampled((leg,)) - middle).T).min() < 3e-3
    np.testing.assert_allclose(leg.at(leg.end_s).place.xy_m, (1.0, 0.6), atol=1e-9)


def test_a_sharp_corner_ends_a_leg_at_the_point() -> None:
    first, second = legs_through(BACK)
    np.testing.assert_allclose(first.at(first.end_s).place.xy_m, (0.8, 0.0), atol=1e-12)
    assert second.start.xy_m.tolist() == [0.8, 0.0]
    assert abs(second.start.heading_rad) > 3.0


@pytest.mark.parametrize(("turn_deg", "legs"), [(100, 1), (-100, 1), (120, 2), (-120, 2)])
def test_a_corner_is_a_stop_from_108_degrees_on_however_much_room_there_is(
    turn_deg: float, legs: int
) -> None:
    turn_rad = np.radians(turn_deg)
    end = (2.0 + 2.0 * float(np.cos(turn_rad)), 2.0 * float(np.sin(turn_rad)))
    assert len(legs_through([(0.0, 0.0), (2.0, 0.0), end])) == legs


def test_a_corner_between_short_sides_is_tighter_or_a_stop() -> None:
    (tight,) = legs_through([(0.0, 0.0), (0.1, 0.0), (0.1, 0.1)], radius_m=0.5)
    assert max(abs(arc.turn_rad) / arc.length_m for arc in tight.arcs) == pytest.approx(1 / 0.05)
    assert len(legs_through([(0.0, 0.0), (0.04, 0.0), (0.04, 0.04)], radius_m=0.5)) == 2


@pytest.mark.parametrize("points", [[], [(1.0, 2.0)], [(0.0, 0.0), (0.001, 0.0), (0.0, 0.001)]])
def test_there_is_no_way_to_where_one_is(points: Points) -> None:
    assert legs_through(points) == ()


coordinates = st.floats(-1.5, 1.5)


@settings(max_examples=40)
@given(st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=8))
def test_any_way_is_whole_ends_at_the_last_point_and_is_never_far_off(points: Points) -> None:
    legs = legs_through(points, radius_m=0.12)
    if not legs:
        return
    for one, following in pairwise(legs):
        np.testing.assert_allclose(one.at(one.end_s).place.xy_m, following.start.xy_m, atol=1e-6)
    for leg in legs:
        assert all(abs(arc.turn_rad) / arc.length_m <= 1 / 0.03 + 1e-6 for arc in leg.arcs)
    end = legs[-1].at(legs[-1].end_s).place.xy_m
    assert np.hypot(*(end - points[-1])) < 0.0051  # points nearer than 5 mm are one
    assert off_m(sampled(legs), points).max() < 0.12


def driven(
    legs: tuple[Course, ...], seconds: float, may: Callable[[float], bool] = lambda _: True
) -> np.ndarray:
    """Return where an ideal robot is that obeys, every 1/30 s, shape (n, 2)."""
    follower, place, twist, places = PatientFollower(legs), Place(0.0, 0.0, 2.5), STILL, []
    for n in range(round(seconds / STEP_S)):
        wanted = follower(View(0, n * STEP_S, twist, place=place))
        twist = wanted if may(n * STEP_S) else STILL
        place = place.moved(twist.speed_mps * STEP_S, twist.turn_rate_radps * STEP_S)
        places.append(place.xy_m)
    return np.array(places)


@pytest.mark.parametrize("points", [L_SHAPE, BACK])
def test_a_robot_keeps_to_its_way_and_stays_at_the_end(points: Points) -> None:
    legs = legs_through(points)
    places = driven(legs, 25.0)
    apart = np.hypot(*(places[:, None] - sampled(legs)[None]).transpose(2, 0, 1))
    assert apart.min(axis=1).max() < 0.015
    assert np.hypot(*(places[-1] - points[-1])) < 0.02
    assert np.ptp(places[-60:], axis=0).max() < 1e-3


def test_a_robot_that_is_held_up_goes_on_and_cuts_no_corner() -> None:
    legs = legs_through(L_SHAPE)
    places = driven(legs, 40.0, may=lambda time_s: not 3.0 < time_s < 15.0)
    apart = np.hypot(*(places[:, None] - sampled(legs)[None]).transpose(2, 0, 1))
    assert apart.min(axis=1).max() < 0.015
    assert np.hypot(*(places[-1] - L_SHAPE[-1])) < 0.02


def test_stands_still_where_nobody_knows_where_it_is() -> None:
    follower = PatientFollower(legs_through(L_SHAPE))
    assert follower(View(0, 0.0, STILL)) == STILL
    assert PatientFollower(())(View(0, 0.0, STILL, place=Place(0.0, 0.0, 0.0))) == STILL


def test_turns_on_the_spot_before_it_drives() -> None:
    follower = PatientFollower(legs_through(L_SHAPE))
    assert follower(View(0, 0.0, STILL, place=Place(0.0, 0.0, -1.0))) == Twist(0.0, 3.0)
