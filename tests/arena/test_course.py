"""Timed paths: continuous, as long and as fast as they say, and at rest at both ends."""

import numpy as np
import pytest

from tagmetry.arena.controllers import Arc, Course, line_loop_line
from tagmetry.arena.place import Place, turned_rad
from tagmetry.errors import InputError

HERE = Place(0.3, -0.1, 0.4)
COURSES = {
    "seed 001": line_loop_line(HERE),
    "too short to cruise": Course(HERE, (Arc(0.05, 0.5),), 0.5, 0.3),
    "late": Course(HERE, (Arc(0.5), Arc(0.3, -2.0)), 0.1, 0.4, start_s=3.0),
}


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_its_motion_is_its_place_s_rate(course):
    step_s = 1e-4
    for time_s in np.linspace(course.start_s - 0.5, course.end_s + 0.5, 97) + 1e-3:
        before, now, after = (course.at(time_s + k * step_s) for k in (-1, 0, 1))
        step = after.place.seen_from(before.place)
        assert step.x_m / (2 * step_s) == pytest.approx(now.twist.speed_mps, abs=2e-3)
        turn = turned_rad(step.heading_rad) / (2 * step_s)
        assert turn == pytest.approx(now.twist.turn_rate_radps, abs=0.03)


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_it_rests_at_its_ends_and_is_never_too_fast(course):
    assert course.at(course.start_s - 1) == course.at(course.start_s)
    assert course.at(course.start_s).place.distance_m(course.start) < 1e-12
    end, later = course.at(course.end_s), course.at(course.end_s + 5)
    assert end.place.distance_m(later.place) < 1e-9
    assert later.twist.speed_mps == 0
    speeds = [course.at(t).twist.speed_mps for t in np.linspace(course.start_s, course.end_s, 500)]
    assert max(speeds) <= course.speed_mps + 1e-12
    assert np.trapezoid(speeds, np.linspace(course.start_s, course.end_s, 500)) == pytest.approx(
        course.length_m, rel=1e-3
    )


def test_a_full_loop_comes_back_to_the_line():
    course = line_loop_line(Place(0, 0, 0), line_m=0.8, radius_m=0.35)
    end = course.at(course.end_s).place
    assert (end.x_m, end.y_m, end.heading_rad) == pytest.approx((1.6, 0, 0), abs=1e-9)


def test_impossible_courses_are_refused():
    with pytest.raises(InputError, match="positive length"):
        Course(HERE, ())
    with pytest.raises(InputError, match="positive speed"):
        Course(HERE, (Arc(1.0),), speed_mps=0.0)
