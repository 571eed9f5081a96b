"""The arena behind the page: it obeys, it stops when the page that drives is gone, it records."""

import time
from collections.abc import Callable, Iterator
from math import hypot
from pathlib import Path

import numpy as np
import pytest
from live_server import eventually

from tagmetry.arena.controllers import ShieldRules, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place
from tagmetry.errors import InputError
from tagmetry.live.messages import (
    Asked,
    Beat,
    ChooseScenario,
    FollowPath,
    GoTo,
    Halt,
    Health,
    Release,
    Resume,
    SetParameter,
    Stage,
    StartRecording,
    Stop,
    StopRecording,
    Told,
    World,
)
from tagmetry.live.show import watch as watch_module
from tagmetry.live.show.errands import toward_goal
from tagmetry.live.show.orders import Order, Orders
from tagmetry.live.show.programme import Programme
from tagmetry.live.show.runner import LiveRunner
from tagmetry.live.show.steered import Steered
from tagmetry.live.show.watch import BEAT_S, PATIENCE_S, Watch
from tagmetry.pipeline.arena_twin import TwinArena
from tagmetry.pipeline.arena_twin.ready import ready_scenario
from tagmetry.record.mcap import STATES, read_entries
from tagmetry.twin.robots import RobotDesign

ROBOTS, PAGE, OTHER = 2, 1, 2


class Running:
    """A runner, and the newest that it told."""

    def __init__(self, folder: Path) -> None:
        self.newest: dict[str, Told] = {}
        programme = Programme("leader_follower", ROBOTS, folder, pictures=False)
        self.runner = LiveRunner(programme, self.take)

    def take(self, message: Told) -> None:
        self.newest[type(message).__name__] = message

    @property
    def world(self) -> World:
        return self.newest["World"]

    @property
    def health(self) -> Health:
        return self.newest["Health"]

    def until(self, is_so: Callable[[World], bool], seconds: float = 20.0) -> None:
        """Wait for a world, while the page says that it is there."""
        end_s = time.monotonic() + seconds
        while "World" not in self.newest or not is_so(self.world):
            assert time.monotonic() < end_s
            self.runner.ask(PAGE, Beat())
            time.sleep(0.02)


@pytest.fixture
def live(tmp_path: Path) -> Iterator[Running]:
    running = Running(tmp_path)
    with running.runner:
        running.until(lambda world: len(world.robots) == ROBOTS)
        yield running


def test_stops_and_releases(live: Running) -> None:
    live.runner.ask(PAGE, Stop("a person"))
    live.until(lambda world: world.is_stopped and all(one.is_stopped for one in world.robots))
    assert live.world.why == "a person"
    assert "a person" in live.world.robots[0].why
    live.runner.ask(PAGE, Release())
    live.until(lambda world: not any(one.is_stopped for one in world.robots))


def test_a_robot_goes_where_it_is_sent_and_back_to_its_controller(live: Running) -> None:
    live.runner.ask(PAGE, GoTo(0, -0.65, 0.05))
    live.until(lambda world: near(world, 0, (-0.65, 0.05)), 60)
    assert live.world.robots[0].path_m == ((-0.65, 0.05),)
    live.runner.ask(PAGE, Resume(0))
    live.until(lambda world: world.robots[0].task == "own")


def test_a_robot_walks_through_points_and_others_go_on(live: Running) -> None:
    points = ((-0.6, 0.3), (-0.3, 0.3))
    live.runner.ask(PAGE, FollowPath(0, points))
    live.until(lambda world: near(world, 0, points[-1]), 60)
    assert (live.world.robots[0].task, live.world.robots[0].path_m) == ("walk", points)
    assert live.world.robots[1].task == "own"


def test_one_robot_is_halted_and_resumed(live: Running) -> None:
    live.until(lambda world: world.robots[0].speed_mps > 0.05, 60)
    live.runner.ask(PAGE, Halt(0))
    live.until(lambda world: world.robots[0].task == "wait" and stands(world))
    assert not live.world.is_stopped
    live.runner.ask(PAGE, Resume(0))
    live.until(lambda world: world.robots[0].speed_mps > 0.05, 60)


def stands(world: World) -> bool:
    return all(abs(one.speed_mps) < 0.01 for one in world.robots)


def test_wheels_turn_as_the_robot_moves(live: Running) -> None:
    live.until(lambda world: world.robots[0].speed_mps > 0.15, 60)
    one, design = live.world.robots[0], RobotDesign()
    assert one.wheels_radps is not None
    rolled_mps = design.drive.wheel_radius_m * sum(one.wheels_radps) / 2
    assert abs(rolled_mps - one.speed_mps) < 0.05


def test_a_parameter_is_set_and_told(live: Running) -> None:
    live.runner.ask(PAGE, SetParameter("length_m", 0.3))
    live.until(lambda _: parameters(live)["length_m"] == 0.3)
    live.until(lambda world: apart_m(world) > 0.28, 60)


def parameters(live: Running) -> dict[str, float]:
    stage = live.newest["Stage"]
    assert isinstance(stage, Stage)
    return {one.name: one.value for one in stage.parameters}


def apart_m(world: World) -> float:
    one, other = world.robots
    return hypot(one.x_m - other.x_m, one.y_m - other.y_m)


def near(world: World, robot: int, goal_m: tuple[float, float]) -> bool:
    one = world.robots[robot]
    return hypot(one.x_m - goal_m[0], one.y_m - goal_m[1]) < 0.03


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (GoTo(99, 0.0, 0.0), "there is no robot 99"),
        (GoTo(0, 50.0, 0.0), "a place on the floor"),
        (FollowPath(0, ((0.0, 0.0), (0.0, 0.9))), "a place on the floor"),
        (FollowPath(0, ()), "1 to 40 points, got 0"),
        (FollowPath(0, 41 * ((0.0, 0.0),)), "1 to 40 points, got 41"),
        (FollowPath(9, ((0.0, 0.0),)), "there is no robot 9"),
        (Halt(9), "there is no robot 9"),
        (SetParameter("fly", 1.0), "there is no parameter 'fly'; there are ahead_per_s"),
        (SetParameter("length_m", 5.0), "length_m is 0.17 to 0.5, got 5"),
        (ChooseScenario("fly", 2), "there is no scenario 'fly'"),
        (ChooseScenario("disperse", 0), "1 to 100 robots"),
        (ChooseScenario("disperse", 10**9), "1 to 100 robots"),
    ],
    ids=str,
)
def test_what_cannot_be_done_is_told_and_all_goes_on(
    live: Running, asked: Asked, told: str
) -> None:
    live.runner.ask(PAGE, asked)
    live.until(lambda _: told in live.health.notice)
    then_s = live.world.time_s
    live.until(lambda world: world.time_s > then_s)


def test_chooses_another_scenario(live: Running) -> None:
    live.runner.ask(PAGE, ChooseScenario("aggregate", 3))
    live.until(lambda world: len(world.robots) == 3)
    live.until(lambda _: live.health.scenario == "aggregate")


@pytest.mark.parametrize("how", ["closed", "silent"])
def test_robots_stop_when_the_page_that_drives_is_gone(live: Running, how: str) -> None:
    live.runner.ask(PAGE, Release())
    live.until(lambda world: world.robots[0].speed_mps > 0.05, 60)
    gone_s = time.monotonic()
    if how == "closed":
        live.runner.leave(PAGE)
    eventually(lambda: live.world.is_stopped)
    assert "closed, hidden or cut off" in live.world.why
    assert how == "silent" or time.monotonic() - gone_s < PATIENCE_S


def test_a_page_that_only_looks_may_go(live: Running) -> None:
    live.runner.ask(PAGE, Release())
    live.until(lambda world: not world.is_stopped)
    live.runner.leave(OTHER)
    then_s = live.world.time_s
    live.until(lambda world: world.time_s > then_s + 0.5)
    assert not live.world.is_stopped


def test_the_page_is_missed_and_robots_stand_within_half_a_second() -> None:
    """0.3 s of silence, one tick, and what a pressed stop takes until wheels stand."""
    with_pause_s = PATIENCE_S + standstill_s()
    assert with_pause_s < 0.5
    assert PATIENCE_S > 2 * BEAT_S


def standstill_s() -> float:
    """Return how long robots at speed roll on, in simulated time."""
    arena = TwinArena(ready_scenario("leader_follower", ROBOTS))
    moments = list(arena.run(3.0))
    assert moments[-1].twists[0].speed_mps > 0.1
    arena.stop()
    stopped_s = arena.time_s
    for moment in arena.run(1.0):
        if all(abs(twist.speed_mps) < 0.01 for twist in moment.twists.values()):
            arena.close()
            return moment.time_s - stopped_s
    raise AssertionError("they never stand")


def test_the_watch_hears_the_page_that_drives_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = [0.0]
    monkeypatch.setattr(watch_module.time, "monotonic", lambda: now_s[0])
    watch = Watch()
    assert not watch.is_gone()
    watch.drive(PAGE)
    now_s[0] = 0.2
    watch.hear(OTHER)
    now_s[0] = 0.4
    assert watch.is_gone()
    watch.hear(PAGE)
    assert not watch.is_gone()
    assert watch.is_driving(PAGE)
    assert not watch.is_driving(OTHER)
    watch.rest()
    now_s[0] = 9.0
    assert not watch.is_gone()


def test_records_what_happens(live: Running, tmp_path: Path) -> None:
    live.runner.ask(PAGE, StartRecording())
    live.until(lambda _: live.health.recording is not None)
    name, then_s = live.health.recording, live.world.time_s
    live.until(lambda world: world.time_s > then_s + 0.5)
    live.runner.ask(PAGE, StopRecording())
    live.until(lambda _: live.health.recording is None)
    live.runner.close()
    topics = [entry.topic for entry in read_entries(tmp_path / name)]
    assert topics.count(STATES) > 8


def test_a_stop_makes_void_what_waits_and_is_always_taken() -> None:
    orders = Orders()
    for _ in range(100):
        orders.put(Order(PAGE, Release()))
    with pytest.raises(InputError, match="100 commands wait"):
        orders.put(Order(PAGE, Release()))
    orders.put(Order(OTHER, Stop()))
    orders.put(Order(PAGE, GoTo(1, 0.0, 0.0)))
    assert [type(order.asked) for order in orders.take()] == [Stop, GoTo]
    assert orders.take() == []


def test_time_does_not_pass_for_a_controller_that_is_not_asked() -> None:
    times = []

    def control(view: View) -> Twist:
        times.append(view.time_s)
        return STILL

    steered = Steered(control, ShieldRules())
    for time_s in (0.0, 0.1, 0.2, 5.2, 5.3):
        steered(View(0, time_s, STILL))
    np.testing.assert_allclose(times, [0.0, 0.1, 0.2, 0.2, 0.3], atol=1e-12)


def test_a_robot_turns_to_its_goal_before_it_drives() -> None:
    behind = View(0, 0.0, STILL, place=Place(0.0, 0.0, np.pi))
    assert toward_goal(behind, (1.0, 0.0)).speed_mps == 0.0
    ahead = View(0, 0.0, STILL, place=Place(0.0, 0.0, 0.0))
    assert toward_goal(ahead, (1.0, 0.0)) == Twist(0.25, 0.0)
    assert toward_goal(ahead, (0.01, 0.0)) == STILL
    assert toward_goal(View(0, 0.0, STILL), (1.0, 0.0)) == STILL
