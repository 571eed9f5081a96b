"""Robots with controllers of their own beside one that a person has sent somewhere."""

import pytest

from tagmetry.arena.controllers import ShieldRules, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.told import Neighbour
from tagmetry.live.show.steered import Steered

AHEAD = View(0, 0.0, STILL, (Neighbour(1, 0.2, 0.0, 0.0, 0.0), Neighbour(2, 0.2, 3.1, 0.0, 0.0)))


@pytest.mark.parametrize(("sent", "speed_mps"), [((), 0.2), ((2,), 0.2), ((1,), 0.0732)])
def test_a_leader_on_its_course_slows_before_a_robot_that_was_sent_there(sent, speed_mps):
    """Half of 20 mm of free air, stopped for at 1 m/s^2 after 0.1 s: v t + v^2 / 2 = 10 mm."""
    leader = Steered(lambda _view: Twist(0.2, 0.5), ShieldRules(), lambda robot: robot in sent)
    wish = leader(AHEAD)
    assert wish.speed_mps == pytest.approx(speed_mps, abs=1e-4)
    assert wish.turn_rate_radps == 0.5


def test_robots_know_who_of_them_was_sent():
    pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")
    from tagmetry.live.show.stage import steerable
    from tagmetry.pipeline.arena_twin.ready import ready_scenario

    _, steered = steerable(ready_scenario("leader_follower", 2))
    asked = steered[0]._is_sent
    assert not asked(1)
    steered[1].errand = lambda _view: STILL
    assert asked(1)
    assert not asked(7)
