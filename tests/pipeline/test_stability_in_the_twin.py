"""What the stability report expects of a drive, and what MuJoCo's robots do on it."""

from functools import partial

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from tagmetry.arena.controllers import Arc, Course, PathFollower, Spring, SpringFollower
from tagmetry.arena.place import Place
from tagmetry.arena.stability import FollowingSetting, stability
from tagmetry.pipeline.arena_twin import Radio, Scenario, TwinArena, TwinRobot
from tagmetry.pipeline.arena_twin.ready import stage
from tagmetry.pipeline.arena_twin.run import TICK_S
from tagmetry.twin.robots import RobotDesign

DESIGN = RobotDesign()


def setting(delay_s, stiffness_per_s=10.0):
    """Return the twin's loop: its computers look at what has arrived every 8 ms."""
    return FollowingSetting(
        Spring(stiffness_per_s=stiffness_per_s),
        delay_s,
        untold_s=TICK_S,
        motor_s=DESIGN.servo_time_s,
        hold_s=DESIGN.servo_hold_s,
    )


def driven(course, delay_s, spring):
    """Return times and distances between leader and follower, shape (n, 2)."""
    leader = TwinRobot(stage.robot(0), course.start, partial(PathFollower, course))
    behind = course.start.moved(-0.2, 0.0)
    follower = TwinRobot(stage.robot(1), behind, partial(SpringFollower, 0, spring))
    arena = TwinArena(
        Scenario(
            (leader, follower),
            stage.view(),
            camera_delay_s=0.7 * delay_s,
            radio=Radio(0.3 * delay_s, 0.0),
        )
    )
    moments = arena.run(course.end_s + 2)
    gaps = [(one.time_s, one.places[0].distance_m(one.places[1])) for one in moments]
    arena.close()
    return np.array(gaps)


@pytest.mark.parametrize("delay_s", [0.05, 0.1])
def test_robots_come_as_near_as_the_report_says(delay_s):
    """Within 1.5 mm; where the leader starts from rest, its gears stick and the gap grows more."""
    course = Course(Place(-0.4, 0.0, 0.0), (Arc(0.5), Arc(0.4, 1.0)), start_s=1.0)
    gaps_m = driven(course, delay_s, Spring())[:, 1]
    expected = stability(setting(delay_s), course=course)
    assert gaps_m.min() == pytest.approx(expected.nearest_m, abs=0.0015)
    assert gaps_m.max() == pytest.approx(expected.farthest_m, abs=0.006)
    assert np.abs(gaps_m - 0.2).max() < 1.6 * expected.worst_m


@pytest.mark.slow
def test_robots_swing_up_where_the_report_says():
    edge = next(w for w in np.arange(10.0, 40.0, 0.5) if not stability(setting(0.1, w)).is_stable)
    course = Course(Place(-1.3, 0.0, 0.0), (Arc(2.8),), start_s=1.0)
    for share, swings_up in ((0.85, False), (1.2, True)):
        time_s, gap_m = driven(course, 0.1, Spring(stiffness_per_s=share * edge)).T
        early, late = (np.ptp(gap_m[(time_s > t) & (time_s < t + 2)]) for t in (4.0, 10.0))
        assert late > 1.3 * early if swings_up else late < 0.8 * early
