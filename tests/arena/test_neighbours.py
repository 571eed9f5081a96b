"""What a robot is told is what it would sense, in its own frame."""

import weakref
from collections.abc import Callable

import numpy as np
import pytest

from tagmetry.arena import Disc, Neighbourhood, NeighbourSensor, RobotState, Told, Wall, WorldState
from tagmetry.errors import InputError


def state(
    number: int, x_m: float, y_m: float, heading: float = 0.0, time_s: float = 0.0
) -> RobotState:
    return RobotState(
        number, f"robot {number}", x_m, y_m, heading, 0.0, 0.0, np.eye(5), 0.01, True, time_s
    )


def world(*robots: RobotState, time_s: float = 0.0) -> WorldState:
    return WorldState(time_s, robots)


def told_to(number: int, told: tuple[Told, ...]) -> Told:
    return next(one for one in told if one.robot_id == number)


def test_bearing_is_from_the_front_counter_clockwise() -> None:
    """Robot 1 looks along the world's y: what is at the world's +x is on its right."""
    seen = world(state(1, 1.0, 1.0, np.pi / 2), state(2, 1.3, 1.0, np.pi))
    (one,) = told_to(1, Neighbourhood(NeighbourSensor(0.5)).tell(seen)).neighbours
    assert one.id == 2
    assert one.range_m == pytest.approx(0.3)
    assert one.bearing_rad == pytest.approx(-np.pi / 2)
    assert one.relative_heading_rad == pytest.approx(np.pi / 2)


def test_what_is_told_leads_to_the_neighbours_place() -> None:
    rng = np.random.default_rng(0)
    robots = [state(n, *rng.uniform(-1, 1, 2), rng.uniform(-3, 3)) for n in range(12)]
    by_id = {one.id: one for one in robots}
    for told in Neighbourhood(NeighbourSensor(5.0)).tell(world(*robots)):
        own = by_id[told.robot_id]
        assert len(told.neighbours) == 11
        assert sorted(told.neighbours, key=lambda n: n.range_m) == list(told.neighbours)
        for near in told.neighbours:
            direction = own.heading_rad + near.bearing_rad
            x_m = own.x_m + near.range_m * np.cos(direction)
            y_m = own.y_m + near.range_m * np.sin(direction)
            other = by_id[near.id]
            assert (x_m, y_m) == pytest.approx((other.x_m, other.y_m))
            turn = own.heading_rad + near.relative_heading_rad - other.heading_rad
            assert np.cos(turn) == pytest.approx(1.0)


def test_only_what_is_within_reach_is_told() -> None:
    seen = world(state(1, 0, 0), state(2, 0.499, 0), state(3, 0.501, 0.0))
    assert [n.id for n in Neighbourhood(NeighbourSensor(0.5)).tell(seen)[0].neighbours] == [2]


def test_only_what_is_in_the_field_of_view_is_told() -> None:
    seen = world(state(1, 0, 0, 0.5), *(state(n, np.cos(n), np.sin(n)) for n in (2, 3, 4, 5)))
    narrow = NeighbourSensor(2.0, view_rad=1.0, view_center_rad=2.5)  # 2.5 to 3.5 in the world
    assert [n.id for n in Neighbourhood(narrow).tell(seen)[0].neighbours] == [3]


@pytest.mark.parametrize(
    ("obstacle", "is_hidden"),
    [
        (Wall((0.5, -0.1), (0.5, 0.1)), True),
        (Wall((0.5, 0.01), (0.5, 0.5)), False),
        (Wall((1.1, -0.1), (1.1, 0.1)), False),
        (Wall((-0.2, -0.1), (-0.2, 0.1)), False),
        (Wall((0.2, 0.0), (0.8, 0.001)), True),
        (Disc((0.5, 0.05), 0.06), True),
        (Disc((0.5, 0.05), 0.04), False),
        (Disc((1.3, 0.0), 0.2), False),
    ],
)
def test_what_is_behind_an_obstacle_is_not_told(obstacle: Wall | Disc, is_hidden: bool) -> None:
    seen = world(state(1, 0, 0), state(2, 1.0, 0))
    blind = Neighbourhood(NeighbourSensor(2.0, line_of_sight=True), obstacles=[obstacle])
    assert (blind.tell(seen)[0].neighbours == ()) is is_hidden
    through = Neighbourhood(NeighbourSensor(2.0), obstacles=[obstacle])
    assert len(through.tell(seen)[0].neighbours) == 1


def test_robots_hide_robots() -> None:
    seen = world(state(1, 0, 0), state(2, 0.5, 0.0), state(3, 1.0, 0.02), state(4, 0.4, 0.4))
    sensor = NeighbourSensor(2.0, line_of_sight=True)
    hidden = Neighbourhood(sensor, radii_m=dict.fromkeys(range(5), 0.08))
    assert [n.id for n in hidden.tell(seen)[0].neighbours] == [2, 4]
    thin = Neighbourhood(sensor, radii_m=dict.fromkeys(range(5), 0.005))
    assert [n.id for n in thin.tell(seen)[0].neighbours] == [2, 4, 3]


def test_obstacles_are_told_by_their_nearest_point() -> None:
    obstacles = [Disc((0.0, 1.0), 0.4, "pillar"), Wall((0.5, -1), (0.5, 1), "wall")]
    (told,) = Neighbourhood(NeighbourSensor(0.7), obstacles=obstacles).tell(world(state(1, 0, 0)))
    wall, pillar = told.obstacles
    assert (wall.name, wall.range_m, wall.bearing_rad) == ("wall", pytest.approx(0.5), 0.0)
    assert (pillar.name, pillar.range_m) == ("pillar", pytest.approx(0.6))
    assert pillar.bearing_rad == pytest.approx(np.pi / 2)


def many(sensor: NeighbourSensor, count: int = 4000) -> np.ndarray:
    """Return what one neighbour at 0.4 m and bearing 0.3 is told as, shape (n, 3)."""
    place = Neighbourhood(sensor, seed=3)
    seen = (state(1, 0, 0), state(2, 0.4 * np.cos(0.3), 0.4 * np.sin(0.3), 0.7))
    told = [place.tell(world(*seen, time_s=k / 30))[0].neighbours for k in range(count)]
    return np.array([(n.range_m, n.bearing_rad, n.relative_heading_rad) for t in told for n in t])


def test_noise_is_as_large_as_asked() -> None:
    values = many(NeighbourSensor(1.0, range_sd_m=0.003, range_sd_share=0.01, bearing_sd_rad=0.02))
    assert values[:, 0].mean() == pytest.approx(0.4, abs=3e-4)
    assert values[:, 0].std() == pytest.approx(0.005, rel=0.05)
    assert values[:, 1].std() == pytest.approx(0.02, rel=0.05)
    assert values[:, 2].std() < 1e-12


def test_neighbours_drop_out_as_often_as_asked() -> None:
    assert len(many(NeighbourSensor(1.0, drop_probability=0.25))) == pytest.approx(3000, abs=110)


def test_what_is_told_is_rounded_as_asked() -> None:
    (one,) = many(NeighbourSensor(1.0, range_step_m=0.03, angle_step_rad=0.25), 1)
    assert tuple(one) == pytest.approx((0.39, 0.25, 0.75))


def test_what_is_told_late_is_as_it_was() -> None:
    place = Neighbourhood(NeighbourSensor(5.0, delay_s=0.1))
    told = [
        place.tell(world(state(1, 0, 0), state(2, 0.1 * k, 0), time_s=0.05 * k))[0]
        for k in range(1, 6)
    ]
    assert [one.neighbours for one in told[:2]] == [(), ()]
    assert [one.neighbours[0].range_m for one in told[2:]] == pytest.approx([0.1, 0.2, 0.3])
    assert told[4].neighbours[0].age_s == pytest.approx(0.11)


def test_worlds_that_no_sensor_tells_of_any_more_are_forgotten() -> None:
    late = NeighbourSensor(5.0, delay_s=0.1)
    place = Neighbourhood(NeighbourSensor(5.0), sensors={1: late})
    kept: list[weakref.ref[WorldState]] = []
    for k in range(100):
        now = world(state(1, 0, 0), state(2, 0.01 * k, 0), time_s=0.01 * k)
        told = place.tell(now)
        kept.append(weakref.ref(now))
    assert sum(one() is not None for one in kept) <= 13
    assert told_to(1, told).neighbours[0].range_m == pytest.approx(0.89)
    assert told_to(2, told).neighbours[0].range_m == pytest.approx(0.99)


def test_at_most_so_many_are_told_the_nearest() -> None:
    seen = world(*(state(n, 0.1 * n, 0) for n in range(6)))
    told = Neighbourhood(NeighbourSensor(5.0, most=2)).tell(seen)
    assert [n.id for n in told[0].neighbours] == [1, 2]


def test_each_robot_has_its_own_sensor_and_random_numbers() -> None:
    noisy = NeighbourSensor(1.0, range_sd_m=0.01)
    few, more = (Neighbourhood(noisy, sensors={3: NeighbourSensor(0.1)}, seed=5) for _ in range(2))
    a, b, c = state(1, 0, 0), state(2, 0.3, 0), state(3, 0, 0.4)
    alone = told_to(2, few.tell(world(a, b)))
    among = more.tell(world(a, b, c))
    assert told_to(2, among).neighbours[0].range_m == alone.neighbours[0].range_m
    assert told_to(3, among).neighbours == ()


def test_the_same_seed_tells_the_same() -> None:
    noisy = NeighbourSensor(1.0, range_sd_m=0.01, bearing_sd_rad=0.1, drop_probability=0.5)
    assert np.array_equal(many(noisy, 50), many(noisy, 50))


def test_a_robot_alone_is_told_nothing() -> None:
    (told,) = Neighbourhood().tell(world(state(4, 0, 0)))
    assert (told.robot_id, told.neighbours, told.obstacles) == (4, (), ())
    assert Neighbourhood().tell(world()) == ()


@pytest.mark.parametrize(
    ("make", "match"),
    [
        (lambda: NeighbourSensor(0.0), "range_m must be positive"),
        (lambda: NeighbourSensor(view_rad=7.0), "view_rad must be above 0"),
        (lambda: NeighbourSensor(bearing_sd_rad=-1.0), "bearing_sd_rad must not be negative"),
        (lambda: NeighbourSensor(drop_probability=1.5), "drop_probability is 0 to 1"),
        (lambda: NeighbourSensor(most=-1), "most must not be negative"),
        (lambda: NeighbourSensor(view_center_rad=float("nan")), "view_center_rad must be finite"),
        (lambda: Disc((0, 0), -1.0), "positive radius"),
        (lambda: Wall((1, 1), (1, 1)), "two different finite ends"),
    ],
)
def test_refuses_sensors_and_obstacles_that_cannot_be(
    make: Callable[[], object], match: str
) -> None:
    with pytest.raises(InputError, match=match):
        make()
