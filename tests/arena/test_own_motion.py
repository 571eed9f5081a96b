"""A robot's motion as its commands imply it: the first-order lag's own closed form."""

import numpy as np
import pytest

from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.own_motion import OwnMotion


def test_it_follows_a_command_after_the_lag():
    motion = OwnMotion(lag_s=0.1)
    motion.command(Twist(0.3, -1.0), acts_s=1.0)
    for time_s in (1.0, 1.05, 1.4):
        share = 1 - np.exp(-(time_s - 1.0) / 0.1)
        at = motion.at(time_s)
        assert (at.speed_mps, at.turn_rate_radps) == pytest.approx((0.3 * share, -share))


def test_it_does_not_depend_on_how_often_it_is_asked():
    often, seldom = OwnMotion(), OwnMotion()
    for motion in (often, seldom):
        motion.command(Twist(0.2, 0.5), 0.0)
    for time_s in np.linspace(0, 0.09, 10):
        often.at(time_s)
    for motion in (often, seldom):
        motion.command(STILL, 0.1)
    assert often.at(0.2).speed_mps == pytest.approx(seldom.at(0.2).speed_mps)


def test_it_begins_at_rest_and_never_goes_back_in_time():
    motion = OwnMotion()
    assert motion.at(5.0) == STILL
    motion.command(Twist(0.2, 0.0), 5.0)
    later = motion.at(5.3)
    assert motion.at(5.1) == later
