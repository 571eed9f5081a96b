"""Places on the floor: the laws of rigid motions in a plane, and arcs against small steps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.arena.place import Place, turned_rad

metres = st.floats(-5, 5)
places = st.builds(Place, metres, metres, st.floats(-3.1, 3.1))


def close(one: Place, other: Place) -> bool:
    turned = turned_rad(one.heading_rad - other.heading_rad)
    return bool(np.allclose([one.x_m - other.x_m, one.y_m - other.y_m, turned], 0, atol=1e-9))


@given(places, places, places)
def test_chaining_is_associative_and_inverse_undoes(a, b, c):
    assert close((a @ b) @ c, a @ (b @ c))
    assert close(a @ a.inverse(), Place(0, 0, 0))
    assert close(a @ b.seen_from(a), b)


@given(places, places)
def test_distance_is_the_same_from_everywhere(a, b):
    seen = b.seen_from(a)
    assert np.hypot(seen.x_m, seen.y_m) == pytest.approx(a.distance_m(b), abs=1e-12)


def test_what_is_to_the_left_of_north_is_west():
    robot = Place(1.0, 2.0, np.pi / 2)
    seen = Place(0.0, 2.0, np.pi).seen_from(robot)
    assert (seen.x_m, seen.y_m) == pytest.approx((0.0, 1.0))
    assert seen.bearing_rad == pytest.approx(np.pi / 2)
    assert seen.heading_rad == pytest.approx(np.pi / 2)


@pytest.mark.parametrize("turn_rad", [0.0, 1e-9, 1e-4, 0.3, -2.0, 2 * np.pi])
def test_an_arc_is_many_small_steps(turn_rad):
    place = Place(0.5, -0.2, 0.7)
    whole = place.moved(0.8, turn_rad)
    steps = 20_000
    headings = 0.7 + turn_rad * (np.arange(steps) + 0.5) / steps
    x_m = 0.5 + 0.8 * np.cos(headings).mean()
    y_m = -0.2 + 0.8 * np.sin(headings).mean()
    assert (whole.x_m, whole.y_m) == pytest.approx((x_m, y_m), abs=1e-8)


@given(st.floats(-50, 50))
def test_a_turned_angle_is_the_same_direction(angle_rad):
    turned = turned_rad(angle_rad)
    assert -np.pi < turned <= np.pi
    assert np.cos(turned) == pytest.approx(np.cos(angle_rad), abs=1e-12)
    assert np.sin(turned) == pytest.approx(np.sin(angle_rad), abs=1e-12)
