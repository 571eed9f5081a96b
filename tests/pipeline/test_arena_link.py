"""What robots hear of an arena's results, over loopback."""

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tagmetry.arena import (
    ArenaStep,
    Decision,
    Neighbourhood,
    NeighbourSensor,
    RobotState,
    Sightings,
    StopForAll,
    WorldState,
)
from tagmetry.arena.drive import Twist
from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.link import Host, RobotClient
from tagmetry.pipeline.arena import ArenaResult
from tagmetry.pipeline.arena.drivers import Drivers
from tagmetry.pipeline.arena.guarded import Guarded
from tagmetry.pipeline.arena.linked import LinkTaker

KEYS = {number: bytes([number]) * 32 for number in (1, 2)}
PATIENCE_S = 20.0  # of a machine that is busy; what is asked for takes milliseconds


def state(number: int, x_m: float) -> RobotState:
    return RobotState(
        number, f"robot {number}", x_m, 0.2, 0.5, 0.1, 0.0, 1e-6 * np.eye(5), 0.0, True, 7.0
    )


WORLD = WorldState(7.0, (state(1, 0.0), state(2, 0.3)))
NOTHING = Sightings(
    np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 3, 3)), np.zeros((0, 3, 3)), np.zeros(0)
)


def result() -> ArenaResult:
    """Return what the arena has to say now: robot 2 must not drive."""
    told = Neighbourhood(NeighbourSensor(0.5)).tell(WORLD)
    decisions = (Decision(1), Decision(2, ("not seen",), "not seen for 1 s"))
    now_s = time.monotonic()
    image = Image(np.zeros((1, 1), np.uint8), 7.0, "capture")
    step = ArenaStep(WORLD, NOTHING, (), None, False, ())
    return ArenaResult(image, (), step, WORLD, told, decisions, StopForAll(), {}, now_s, now_s)


def until(
    is_so: Callable[[], bool],
    clients: list[RobotClient],
    taker: LinkTaker,
    make: Callable[[], ArenaResult] = result,
) -> None:
    """Send results and let the robots hear until something is so."""
    end_s = time.monotonic() + PATIENCE_S
    while not is_so():
        assert time.monotonic() < end_s, "it never came to that"
        taker.take(make())
        for client in clients:
            client.step(0.005)


def test_robots_are_told_neighbours_poses_and_stops() -> None:
    with Host(KEYS, port=0) as host:
        port = host.address[1]
        taker = LinkTaker(host, 0.5, {2: 0.7}, poses=True)
        with RobotClient(1, KEYS[1], port=port) as one, RobotClient(2, KEYS[2], port=port) as two:
            both = [one, two]
            until(lambda: one.neighbours is not None and one.pose is not None, both, taker)
            assert one.neighbours is not None
            assert one.neighbours.range_limit_m == pytest.approx(0.5)
            (near,) = one.neighbours.seen
            assert (near.id, near.range_m) == (2, pytest.approx(0.3, abs=1e-3))
            assert near.bearing_rad == pytest.approx(-0.5, abs=1e-3)
            assert one.pose is not None
            assert (one.pose.x_m, one.pose.y_m) == pytest.approx((0.0, 0.2))
            assert one.pose.sd_position_m == pytest.approx(1e-3)
            until(lambda: two.neighbours is not None, both, taker)
            assert two.neighbours is not None
            assert two.neighbours.range_limit_m == pytest.approx(0.7)
            until(lambda: one.may_move and two.is_linked and not two.may_move, both, taker)


def test_a_real_robot_is_told_of_a_simulated_one_that_has_no_link() -> None:
    with Host({1: KEYS[1]}, port=0) as host, RobotClient(1, KEYS[1], port=host.address[1]) as one:
        taker = LinkTaker(host, 0.5, poses=True, silent={2})
        until(lambda: one.neighbours is not None, [one], taker)
        assert one.neighbours is not None
        assert [near.id for near in one.neighbours.seen] == [2]
        with pytest.raises(InputError, match="there is no robot 2"):
            LinkTaker(host, 0.5, every_s=0.0).take(result())


def test_the_stop_for_all_latches_on_the_robots_until_it_is_released() -> None:
    def stopped() -> ArenaResult:
        return replace(result(), stop=StopForAll().pressed("camera moved", 7.0))

    with Host(KEYS, port=0) as host, RobotClient(1, KEYS[1], port=host.address[1]) as one:
        taker = LinkTaker(host, 0.5)
        until(lambda: one.may_move, [one], taker)
        until(lambda: one.is_stopped, [one], taker, stopped)
        assert not one.may_move
        until(lambda: one.may_move and not one.is_stopped, [one], taker)


def test_controllers_drive_robots_until_they_must_stop() -> None:
    driven = Drivers({3: Guarded(lambda view: Twist(0.1, view.place.x_m))})
    world = WorldState(7.0, (state(3, 0.3),))
    may, must = Decision(3), Decision(3, ("not seen",), "not seen for 1 s")
    assert driven.commands((), world, (may,), {})[3] == Twist(0.1, 0.3)
    assert driven.commands((), world, (must,), {})[3] == Twist(0.0, 0.0)
    driven.close()
