"""Ready-made scenarios do what their names say, and nobody touches anybody."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from tagmetry.arena.drive import Twist
from tagmetry.errors import InputError
from tagmetry.pipeline.arena_twin import TwinArena
from tagmetry.pipeline.arena_twin.ready import driven_scenario, ready_scenario
from tagmetry.pipeline.arena_twin.summary import Summing


def ran(scenario, duration_s):
    arena, summing, moments = TwinArena(scenario), Summing(), []
    for moment in arena.run(duration_s):
        summing.take(moment)
        moments.append(moment)
    arena.close()
    return moments, summing.summary()


def spread_m(moment):
    xy = np.array([place.xy_m for place in moment.places.values()])
    return float(np.linalg.norm(xy - xy.mean(axis=0), axis=1).mean())


def test_trains_follow_at_20_cm():
    moments, summary = ran(ready_scenario("leader_follower", 6), 6.0)
    gaps = [moments[-1].places[n].distance_m(moments[-1].places[n - 1]) for n in (1, 2, 4, 5)]
    assert gaps == pytest.approx([0.2] * 4, abs=0.01)
    assert not summary.touched
    assert summary.place_rms_m < 0.002
    assert summary.driven_m > 3


@pytest.mark.parametrize(("name", "grows"), [("aggregate", False), ("disperse", True)])
def test_swarms_gather_and_spread(name, grows):
    moments, summary = ran(ready_scenario(name, 6), 8.0)
    share = spread_m(moments[-1]) / spread_m(moments[0])
    assert share > 1.2 if grows else share < 0.75
    assert not summary.touched


def test_a_formation_keeps_its_shape():
    moments, summary = ran(ready_scenario("formation", 4), 12.0)
    leader = moments[-1].places[0]
    spots = [moments[-1].places[n].seen_from(leader).xy_m for n in (1, 2, 3)]
    np.testing.assert_allclose(spots, [[-0.28, -0.28], [-0.28, 0], [-0.28, 0.28]], atol=0.07)
    assert not summary.touched


def test_wanderers_explore_and_enter_no_obstacle():
    scenario = ready_scenario("wander", 8)
    moments, summary = ran(scenario, 20.0)
    paths = np.array([[place.xy_m for place in moment.places.values()] for moment in moments])
    near_m = [
        np.hypot(*(one.nearest_point(xy_m) - xy_m))
        for one in scenario.obstacles
        for xy_m in paths[::5].reshape(-1, 2)
    ]
    assert min(near_m) > 0.08
    assert not summary.touched
    reached_m = np.ptp(paths, axis=0).max(axis=1)
    assert reached_m.min() > 0.2
    assert reached_m.mean() > 0.5
    late_m = np.hypot(*np.diff(paths[-150:], axis=0).T).sum(axis=1)
    assert late_m.min() > 0.05  # nobody is caught, 15 s to 20 s


def test_wanderers_start_clear_of_obstacles_however_many():
    for robots in (1, 30):
        scenario = ready_scenario("wander", robots, seed=3)
        assert len(scenario.robots) == robots
        for one in scenario.robots:
            xy_m = one.start.xy_m
            assert all(
                np.hypot(*(it.nearest_point(xy_m) - xy_m)) > 0.15 for it in scenario.obstacles
            )


def test_a_user_s_controllers_know_their_robot():
    scenario = driven_scenario(lambda robot: lambda _view: Twist(0.05 * robot, 0.0), 3)
    moments, _ = ran(scenario, 2.0)
    driven = [moments[-1].places[n].distance_m(moments[0].places[n]) for n in range(3)]
    assert driven[0] < 0.002
    assert 0.05 < driven[1] < driven[2]


def test_unknown_scenarios_and_crowds_are_refused():
    with pytest.raises(InputError, match="no scenario 'dance'"):
        ready_scenario("dance", 3)
    with pytest.raises(InputError, match="1 to 100 robots, got 101"):
        ready_scenario("aggregate", 101)
