"""Other computers see an arena's results, and their commands pass the arena's own safety."""

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field, replace

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
from tagmetry.arena.drive import STILL, Twist
from tagmetry.camera import Image
from tagmetry.link import Command
from tagmetry.link.computers import ArenaBridge, ArenaView, Commander
from tagmetry.pipeline.arena import ArenaResult
from tagmetry.pipeline.arena.bridged import BridgeTaker, RemoteStop, commanded_controllers
from tagmetry.pipeline.arena.drivers import Drivers
from tagmetry.pipeline.arena.guarded import Guarded

pytest.importorskip("zenoh", reason="needs the part zenoh")

KEY = bytes(range(32))
PATIENCE_S = 20.0  # of a machine that is busy; what is asked for takes milliseconds
NAMES = {1: "ada", 2: "bob"}
NOTHING = Sightings(
    np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros((0, 3, 3)), np.zeros((0, 3, 3)), np.zeros(0)
)


def state(number: int, x_m: float, time_s: float) -> RobotState:
    covariance = 1e-6 * np.eye(5)
    return RobotState(
        number, NAMES[number], x_m, 0.2, 0.5, 0.1, 0.0, covariance, 0.05, number == 1, time_s
    )


def seen_world(time_s: float) -> WorldState:
    return WorldState(time_s, (state(1, 0.0, time_s), state(2, 0.3, time_s)))


@dataclass
class Measurement:
    """Stands for an arena that measures: robot 2 must not drive."""

    drivers: Drivers
    stop: StopForAll = field(default_factory=StopForAll)
    sequence: int = 0

    def press_stop(self, why: str, time_s: float) -> None:
        self.stop = self.stop.pressed(why, time_s)

    def release_stop(self) -> None:
        self.stop = self.stop.reset()

    def result(self) -> ArenaResult:
        self.sequence += 1
        now_s, image_s = time.monotonic(), self.sequence / 100
        world = seen_world(image_s + 0.03)  # carried on to when it acts
        told = Neighbourhood(NeighbourSensor(0.5)).tell(world)
        everyone: tuple[Decision, ...] = (Decision(1), Decision(2, ("not seen",), "not seen"))
        if self.stop.is_pressed:
            everyone = tuple(replace(one, reasons=("stop for all",)) for one in everyone)
        commands = self.drivers.commands(told, world, everyone, {})
        image = Image(np.zeros((1, 1), np.uint8), image_s, "capture", self.sequence)
        step = ArenaStep(world, NOTHING, (), None, False, ())
        return ArenaResult(
            image, (), step, world, told, everyone, self.stop, commands, now_s, now_s
        )


@dataclass
class Lab:
    """An arena with a bridge, another computer that looks on and one that commands."""

    bridge: ArenaBridge
    view: ArenaView
    commander: Commander
    measurement: Measurement

    def until(self, is_so: Callable[[], bool]) -> None:
        """Measure and command until something is so."""
        takers = BridgeTaker(self.bridge, 0.5), RemoteStop(self.bridge, self.measurement)
        end_s = time.monotonic() + PATIENCE_S
        while not is_so():
            assert time.monotonic() < end_s, "it never came to that"
            result = self.measurement.result()
            for taker in takers:
                taker.take(result)
            for robot_id in NAMES:
                self.commander.send(robot_id, Command(0.25, turn_radps=0.5))
            self.view.wait(0.01)

    def commanded(self, robot_id: int) -> Command | None:
        return None if self.view.newest is None else self.view.newest.commanded.get(robot_id)


def drivers(bridge: ArenaBridge, own: Callable[[int], Guarded] | None = None) -> Drivers:
    make = commanded_controllers(bridge, own)
    is_driven = (lambda _: True) if own else lambda key: bridge.command(key) is not None
    return Drivers({key: Guarded(make(key), patience_s=5.0) for key in NAMES}, is_driven)


@pytest.fixture
def lab() -> Iterator[Lab]:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{found.getsockname()[1]}"
    with ExitStack() as stack:
        bridge = stack.enter_context(ArenaBridge("lab", NAMES, listen=endpoint, command_key=KEY))
        view = stack.enter_context(ArenaView(endpoint, "lab"))
        commander = stack.enter_context(Commander(endpoint, list(NAMES), KEY, "lab"))
        measurement = Measurement(drivers(bridge))
        stack.callback(measurement.drivers.close)
        yield Lab(bridge, view, commander, measurement)


def test_other_computers_see_what_the_arena_sees(lab: Lab) -> None:
    lab.until(lambda: lab.view.newest is not None and lab.view.newest.missing == 0)
    sight = lab.view.newest
    assert sight is not None
    ada, bob = sight.world
    assert (ada.name, bob.name, bob.x_m) == ("ada", "bob", pytest.approx(0.3))
    assert (ada.seen, bob.seen, bob.age_s) == (True, False, pytest.approx(0.05))
    np.testing.assert_allclose(ada.covariance, 1e-6 * np.eye(5))
    assert sight.held == {2}
    (near,) = sight.neighbours[1].seen
    assert (near.id, near.range_m) == (2, pytest.approx(0.3, abs=1e-3))
    assert 0.0 < sight.world.time_s - time.monotonic() + 20 < 20.1  # the clock of this computer
    assert -0.031 <= lab.view.age_s < 5  # the moment is 30 ms after the image


def test_a_command_drives_its_robot_and_is_told_to_all(lab: Lab) -> None:
    lab.until(lambda: lab.commanded(1) == Command(0.25, 0.0, 0.5, 200))
    assert lab.commanded(2) == Command(valid_for_ms=0)  # held, whatever is commanded


def test_the_emergency_stop_of_another_computer_stops_all(lab: Lab) -> None:
    lab.until(lambda: lab.commanded(1) == Command(0.25, 0.0, 0.5, 200))
    lab.commander.stop()
    lab.until(lambda: bool(lab.view.newest and lab.view.newest.is_stopped))
    assert lab.measurement.stop.why == "another computer stops all"
    assert lab.commanded(1) == Command(valid_for_ms=0)
    lab.commander.release()
    lab.until(lambda: bool(lab.view.newest and not lab.view.newest.is_stopped))
    lab.until(lambda: lab.commanded(1) == Command(0.25, 0.0, 0.5, 200))


def test_a_stop_that_others_pressed_is_not_released(lab: Lab) -> None:
    lab.measurement.press_stop("the camera was bumped", 1.0)
    lab.until(lambda: bool(lab.view.newest and lab.view.newest.is_stopped))
    lab.commander.release()
    lab.until(lambda: lab.measurement.sequence > 50)
    assert lab.measurement.stop.is_pressed


def test_a_robot_that_nobody_commands_gets_no_commands(lab: Lab) -> None:
    lab.commander.close()
    lab.measurement.result()
    lab.view.wait(0.01)
    result = lab.measurement.result()
    assert result.commands == {}


def test_a_robot_s_own_controller_drives_while_no_computer_does(lab: Lab) -> None:
    own = drivers(lab.bridge, lambda _robot: lambda _view: Twist(0.125, 0.0))
    lab.measurement.drivers.close()
    lab.measurement.drivers = own
    assert lab.measurement.result().commands == {1: Twist(0.125, 0.0), 2: STILL}
    lab.until(lambda: lab.commanded(1) == Command(0.25, 0.0, 0.5, 200))
    own.close()
