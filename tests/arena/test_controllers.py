"""Controllers on robots with a motor's lag: they arrive, keep their distance, and do not touch."""

import numpy as np
import pytest
from small_world import SmallWorld

from tagmetry.arena.controllers import (
    Aggregate,
    Arc,
    Course,
    Disperse,
    Formation,
    PathFollower,
    Shielded,
    ShieldRules,
    Spring,
    SpringFollower,
    View,
    line_loop_line,
)
from tagmetry.arena.controllers.shield import stoppable_mps
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place
from tagmetry.arena.safety import Fence
from tagmetry.arena.told import NearObstacle, Neighbour

HERE = Place(0.0, 0.0, 0.0)


def still(_view):
    return STILL


@pytest.mark.parametrize("start", [Place(-0.1, 0.1, 0.5), Place(0.05, -0.1, -1.0), HERE])
def test_a_robot_beside_its_path_comes_back_to_it(start):
    course = line_loop_line(HERE)
    world = SmallWorld([start], [PathFollower(course)]).run(course.end_s / 2)
    wanted = course.at(world.time_s).place
    assert world.places[0].distance_m(wanted) < 0.01


def test_who_does_not_know_where_it_is_stands_still():
    follower = PathFollower(line_loop_line(HERE))
    assert follower(View(0, 1.0, Twist(0.2, 0.0))) == STILL


@pytest.mark.parametrize("delay_s", [0.02, 0.1])
def test_the_follower_keeps_its_distance(delay_s):
    """Seed 001, figure 13: at most 0.042 m, 0.041 m on average. Here the goal is 0.02 m."""
    course = line_loop_line(HERE)
    world = SmallWorld(
        [HERE, Place(-0.2, 0.0, 0.0)], [PathFollower(course), SpringFollower(0)], delay_s
    )
    gaps = []
    while world.time_s < course.end_s + 2:
        gaps.append(world.run(0.1).gap_m(0, 1))
    assert np.abs(np.array(gaps) - 0.2).max() < 0.02
    assert gaps[-1] == pytest.approx(0.2, abs=0.002)


def test_without_the_leader_s_speed_it_would_trail():
    """The spring alone stretches by 2 z v / w; the fed speed takes that away."""
    course = line_loop_line(HERE, line_m=3.0)
    followers = [SpringFollower(0), SpringFollower(0)]
    followers[1]._motion.see = _without_speed(followers[1]._motion.see)
    gaps = []
    for follower in followers:
        world = SmallWorld([HERE, Place(-0.2, 0.0, 0.0)], [PathFollower(course), follower])
        gaps.append(world.run(8.0).gap_m(0, 1))
    assert gaps[0] == pytest.approx(0.2, abs=0.002)
    assert gaps[1] == pytest.approx(0.2 + 2 * 0.2 / Spring().stiffness_per_s, abs=0.005)


def _without_speed(see):
    def blind(view, neighbour):
        seen = see(view, neighbour)
        return seen and type(seen)(seen.place, STILL)

    return blind


def test_a_follower_that_lost_its_leader_stops():
    follower = SpringFollower(0, Spring(lost_s=0.3))
    seen = Neighbour(0, 0.5, 0.0, 0.0, 0.0)
    for n in range(20):
        going = follower(View(1, n * 0.02, STILL, (seen,)))
    assert going.speed_mps > 0.05
    assert follower(View(1, 0.5, STILL)).speed_mps != 0
    assert follower(View(1, 0.9, STILL)) == STILL


def scattered(count, spread_m, seed=0):
    rng = np.random.default_rng(seed)
    xy = np.empty((0, 2))
    while len(xy) < count:
        spot = rng.uniform(-spread_m, spread_m, 2)
        if len(xy) == 0 or np.linalg.norm(xy - spot, axis=1).min() > 0.22:
            xy = np.vstack([xy, spot])
    return [Place(*spot, rng.uniform(-3, 3)) for spot in xy]


def spread_m(world):
    xy = np.array([(place.x_m, place.y_m) for place in world.places])
    return float(np.linalg.norm(xy - xy.mean(axis=0), axis=1).mean())


def test_a_swarm_gathers_without_touching():
    starts = scattered(8, 0.7)
    world = SmallWorld(starts, [Shielded(Aggregate()) for _ in starts], range_m=1.5)
    before = spread_m(world)
    world.run(40.0)
    assert spread_m(world) < 0.65 * before
    assert min(world.least_m) > 0.16


def test_a_swarm_spreads_until_all_are_far_enough():
    starts = scattered(8, 0.5)
    world = SmallWorld(starts, [Shielded(Disperse(0.4)) for _ in starts], range_m=0.8)
    world.run(40.0)
    assert world.least_m[-1] > 0.38
    assert min(world.least_m) > 0.16


def test_a_formation_goes_with_its_leader():
    shape = {0: HERE, 1: Place(-0.3, 0.3, 0.0), 2: Place(-0.3, -0.3, 0.0)}
    course = line_loop_line(HERE, line_m=1.2, radius_m=0.6)
    starts = [HERE, Place(-0.5, 0.2, 1.0), Place(-0.4, -0.5, -1.0)]
    keep = [Shielded(Formation(shape, 0)) for _ in range(2)]
    world = SmallWorld(starts, [PathFollower(course), *keep]).run(course.end_s + 6)
    for robot in (1, 2):
        spot = world.places[robot].seen_from(world.places[0])
        assert (spot.x_m, spot.y_m) == pytest.approx((shape[robot].x_m, shape[robot].y_m), abs=0.02)


def test_one_who_holds_two_crowds_together_keeps_both_in_reach():
    """A mean would draw it to the nearer crowd; the middle of all, with itself, is 0.3 m ahead."""
    crowd = [Neighbour(n, 0.35, np.pi + 0.1 * (n - 3), 0.0, 0.0) for n in range(7)]
    far = Neighbour(9, 0.95, 0.0, 0.0, 0.0)
    wish = Aggregate()(View(1, 0.0, STILL, (*crowd, far)))
    assert wish.speed_mps == pytest.approx(0.15, abs=1e-3)  # ahead, at its speed
    assert abs(wish.turn_rate_radps) < 0.05
    assert Aggregate()(View(1, 0.0, STILL, tuple(crowd))).speed_mps == 0  # they are behind


def test_a_long_formation_does_not_tear():
    """Most of it does not sense its leader; who heeded those behind would wait for them."""
    shape = {n: Place(-0.3 * n, 0.0, 0.0) for n in range(7)}
    course = Course(HERE, (Arc(2.4),), speed_mps=0.12)
    keep = [Shielded(Formation(shape, 0)) for _ in range(6)]
    starts = [Place(place.x_m, place.y_m, 0.0) for place in shape.values()]
    world = SmallWorld(starts, [PathFollower(course), *keep], range_m=0.7).run(course.end_s + 8)
    for robot, place in shape.items():
        spot = world.places[robot].seen_from(world.places[0])
        assert (spot.x_m, spot.y_m) == pytest.approx((place.x_m, place.y_m), abs=0.08)


def test_a_robot_alone_in_a_formation_or_a_swarm():
    alone = View(1, 0.0, STILL)
    assert Formation({0: HERE, 1: HERE}, 0)(alone) == STILL
    assert Disperse()(alone) == STILL
    assert Aggregate()(alone).speed_mps > 0


@pytest.mark.parametrize("speed_mps", [0.3, -0.3])
def test_the_shield_stops_before_a_robot(speed_mps):
    ahead = Place(0.6 if speed_mps > 0 else -0.6, 0.02, 0.0)
    ram = Shielded(lambda _view: Twist(speed_mps, 0.0), ShieldRules(braking_mps2=0.8))
    world = SmallWorld([HERE, ahead], [ram, still], delay_s=0.06).run(6.0)
    assert 0.16 < min(world.least_m) < 0.2


def test_each_of_two_robots_takes_half_of_the_gap():
    rules = ShieldRules()
    ahead = View(0, 0.0, STILL, (Neighbour(1, 0.36, 0.0, 0.0, 0.0),))
    fast = Shielded(lambda _view: Twist(2.0, 0.0), rules)(ahead)
    assert fast.speed_mps == pytest.approx(stoppable_mps((0.36 - 0.16 - 0.02) / 2, rules))


def test_a_turn_toward_a_robot_counts_as_done():
    """At 80 degrees aside nothing is ahead yet; after 0.1 s at 3 rad/s it is."""
    aside = View(0, 0.0, STILL, (Neighbour(1, 0.20, np.deg2rad(80), 0.0, 0.0),))
    straight, turning = (
        Shielded(lambda _view, turn=turn: Twist(0.3, turn))(aside).speed_mps for turn in (0.0, 3.0)
    )
    toward = np.cos(np.deg2rad(80) - 0.3)
    assert turning == pytest.approx(stoppable_mps(0.01, ShieldRules()) / toward)
    assert turning < straight


def test_the_shield_lets_a_robot_turn_and_leave():
    beside = View(0, 0.0, STILL, (Neighbour(1, 0.165, 0.0, 0.0, 0.0),))
    wish = Shielded(lambda _view: Twist(0.2, 1.0))(beside)
    assert wish == Twist(0.0, 1.0)
    back = Shielded(lambda _view: Twist(-0.2, 0.0))(beside)
    assert back.speed_mps == -0.2


def test_the_shield_minds_obstacles_and_the_fence():
    wall = View(0, 0.0, STILL, obstacles=(NearObstacle("wall", 0.1, 0.0),))
    assert Shielded(lambda _view: Twist(0.2, 0.0))(wall).speed_mps < 0.1
    fence = Fence(((-1, -1), (1, -1), (1, 1), (-1, 1)))
    runner = Shielded(lambda _view: Twist(0.3, 0.0), ShieldRules(fence=fence))
    world = SmallWorld([Place(0.0, 0.3, 0.5)], [runner]).run(10.0)
    assert 0.85 < world.places[0].x_m <= 0.925
    world.controllers = [Shielded(lambda _view: Twist(-0.2, 0.0), ShieldRules(fence=fence))]
    assert world.run(1.0).places[0].x_m < 0.8


@pytest.mark.parametrize("delay_s", [0.0, 0.15])
def test_a_stoppable_speed_stops_in_the_gap(delay_s):
    rules = ShieldRules(braking_mps2=0.7, delay_s=delay_s)
    for gap_m in (0.01, 0.2, 2.0):
        speed = stoppable_mps(gap_m, rules)
        assert speed * delay_s + speed**2 / (2 * 0.7) == pytest.approx(gap_m)
    assert stoppable_mps(-0.1, rules) == 0
