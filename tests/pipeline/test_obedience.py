"""Which robots count as not doing what they were told."""

import numpy as np
import pytest

from tagmetry.arena import RobotState
from tagmetry.arena.drive import STILL, Twist
from tagmetry.pipeline.arena.obedience import Obedience, excess_radps


def turning(time_s: float, rate_radps: float, age_s: float = 0.0) -> RobotState:
    no_doubt = np.zeros((5, 5))
    return RobotState(1, "ada", 0.0, 0.0, 0.0, 0.0, rate_radps, no_doubt, age_s, age_s == 0, time_s)


@pytest.mark.parametrize(
    ("turns_radps", "wanted_radps", "excess"),
    [
        (2.0, 0.5, 1.5),
        (0.5, 2.0, -0.5),  # weak motors
        (-2.0, 0.5, 2.0),  # the other way: all of it
        (2.0, -0.5, 2.0),
        (-2.0, -0.5, 1.5),
        (-2.0, 0.0, 2.0),
        (0.0, 0.0, 0.0),
    ],
)
def test_only_turning_too_much_counts(turns_radps, wanted_radps, excess):
    assert excess_radps(turns_radps, wanted_radps) == pytest.approx(excess)


def watched(states, told=STILL):
    obedience = Obedience()
    for state in states:
        obedience.watch(state, told)
    return dict(obedience.faults)


def test_a_second_of_it_is_enough_and_stays_for_good():
    times_s = np.arange(0.0, 1.05, 0.1).tolist()
    spinning = [turning(time_s, 1.5) for time_s in times_s]
    assert watched(spinning[:-1]) == {}
    faults = watched([*spinning, turning(9.0, 0.0)])
    assert faults == {1: "it turned with 1.5 rad/s where 0.0 were wanted, for 1 s"}


def test_a_moment_of_it_and_what_nobody_saw_do_not_count():
    halves = [turning(t, 1.5 if t < 0.8 or t > 0.95 else 0.2) for t in np.arange(0, 1.7, 0.1)]
    assert watched(halves) == {}
    guessed = [turning(t, 1.5, age_s=0.1) for t in np.arange(0, 3, 0.1)]
    assert watched(guessed) == {}
    assert watched([turning(t, 3.0) for t in np.arange(0, 3, 0.1)], Twist(0.0, 2.5)) == {}


def test_orders_that_an_image_cannot_show_yet_do_not_count():
    """Told to turn left and right by turns, it does so 1.4 s later."""
    obedience = Obedience()
    for time_s in np.arange(0, 12, 0.1):
        told, seen = (2.0 * (-1) ** int(t / 2.5) for t in (time_s, max(time_s - 1.4, 0.0)))
        obedience.watch(turning(time_s, seen), Twist(0.0, told))
    assert not obedience.faults
