"""Simulated robots among real ones: the arena follows both alike, and each is told of the other."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from twin_arenas import VIEW, twin_robot

from tagmetry.arena import (
    Arena,
    Fence,
    Neighbourhood,
    NeighbourSensor,
    Roster,
    SafetyRules,
)
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place
from tagmetry.pipeline.arena.drivers import Drivers
from tagmetry.pipeline.arena.guarded import Guarded
from tagmetry.pipeline.arena.turning import Turning
from tagmetry.pipeline.arena_twin import CornerEye
from tagmetry.pipeline.arena_twin.virtual import VirtualRobots
from tagmetry.twin.robots import RobotDesign, RobotsPhysics

REAL, GHOST = 0, 5
ROBOTS = tuple(twin_robot(n).robot for n in (REAL, GHOST))
IMAGE_S = 1 / 30


class RealRobot:
    """A robot whose markers the images show: it stands at a place."""

    def __init__(self, place: Place) -> None:
        self._poses = RobotsPhysics([(RobotDesign(), place)]).poses()
        self._eye = CornerEye(ROBOTS[:1], VIEW, np.random.default_rng(7))

    def look(self, time_s: float):
        return self._eye.look(time_s, self._poses)


class Mixed:
    """An arena of a real robot that stands, and of a simulated one with a controller."""

    def __init__(self, control, **more) -> None:
        roster = Roster(ROBOTS)
        self.real = RealRobot(Place(0.9, 0.5, np.pi))
        start = {GHOST: Place(0.2, 0.5, 0.0)}
        self.virtual = VirtualRobots(roster, start, VIEW, np.random.default_rng(0))
        self.turning = Turning(
            Arena(roster, VIEW),
            Neighbourhood(NeighbourSensor(range_m=1.0)),
            SafetyRules(**more),
            Drivers({GHOST: Guarded(control), REAL: Guarded(lambda _view: STILL)}),
        )
        self.time_s = 100.0  # of images: their clock began long ago

    def run(self, duration_s: float):
        for _ in range(round(duration_s / IMAGE_S)):
            self.time_s += IMAGE_S
            markers = self.real.look(self.time_s) + self.virtual.look(self.time_s)
            turn = self.turning.turn(markers, self.time_s, lambda: self.time_s + 0.02)
            self.virtual.drive(turn)
        return turn


def test_each_is_told_of_the_other():
    mixed = Mixed(lambda _view: STILL)
    turn = mixed.run(0.2)
    told = {one.robot_id: one.neighbours for one in turn.told}
    (of_ghost,), (of_real,) = told[REAL], told[GHOST]
    assert (of_ghost.id, of_real.id) == (GHOST, REAL)
    assert of_ghost.range_m == pytest.approx(0.7, abs=1e-3)
    assert of_real.bearing_rad == pytest.approx(0.0, abs=0.01)
    assert abs(of_real.relative_heading_rad) == pytest.approx(np.pi, abs=0.01)


def test_it_drives_as_its_controller_says_and_is_seen_where_it_is():
    mixed = Mixed(lambda _view: Twist(0.1, 0.5))
    turn = mixed.run(3.0)
    true = mixed.virtual.places()[GHOST]
    seen = turn.step.world.robot(GHOST)
    assert true.heading_rad == pytest.approx(1.5, abs=0.06)  # less the start of its motors
    assert np.hypot(seen.x_m - true.x_m, seen.y_m - true.y_m) < 0.003
    assert seen.speed_mps == pytest.approx(0.1, abs=0.01)
    assert seen.seen


def test_it_stops_for_the_real_one_and_at_the_fence():
    def careful(view):
        near = view.neighbour(REAL)
        return Twist(0.2, 0.0) if near is None or near.range_m > 0.3 else STILL

    mixed = Mixed(careful)
    mixed.run(3.0)
    assert mixed.virtual.places()[GHOST].x_m == pytest.approx(0.6, abs=0.04)
    fence = Fence(((-1, -1), (0.5, -1), (0.5, 1), (-1, 1)))
    fenced = Mixed(lambda _view: Twist(0.2, 0.0), fence=fence)
    turn = fenced.run(3.0)
    assert fenced.virtual.places()[GHOST].x_m == pytest.approx(0.42, abs=0.04)
    assert "over its fence" in turn.decisions[1].told


def test_the_stop_for_all_stops_it_and_it_obeys_no_longer_than_it_was_told():
    mixed = Mixed(lambda _view: Twist(0.2, 0.0))
    mixed.run(1.0)
    mixed.turning.stop = mixed.turning.stop.pressed("pressed", mixed.time_s)
    mixed.run(0.4)
    still = mixed.virtual.places()[GHOST]
    mixed.run(0.3)
    assert mixed.virtual.places()[GHOST].distance_m(still) < 1e-3

    mixed = Mixed(lambda _view: Twist(0.2, 0.0))
    mixed.run(1.0)
    before = mixed.virtual.places()[GHOST]
    mixed.virtual.look(mixed.time_s + 5.0)  # no image for so long: it goes on for 0.2 s, and stops
    assert mixed.virtual.places()[GHOST].distance_m(before) == pytest.approx(0.04, abs=0.02)


def driven(virtual: VirtualRobots, twist: Twist) -> np.ndarray:
    """Return where the images of a second show the middle of its marker, shape (30, 2)."""
    told, middles_px = SimpleNamespace(commands={GHOST: twist}), []
    for n in range(30):
        (seen,) = virtual.look(n * IMAGE_S)
        middles_px.append(seen.corners_px.mean(axis=0))
        told.world = SimpleNamespace(time_s=n * IMAGE_S)
        virtual.drive(told)
    return np.array(middles_px)


def test_images_show_it_at_their_own_time_between_the_steps_of_the_physics():
    start = {GHOST: Place(0.6, 0.3, 0.0)}
    virtual = VirtualRobots(Roster(ROBOTS), start, VIEW, np.random.default_rng(0), noise_px=0.0)
    steps_px = np.diff(driven(virtual, Twist(0.2, 0.0))[15:, 0])
    assert steps_px.mean() > 3
    assert steps_px.std() < 0.05


def test_a_smaller_one_has_smaller_wheels_and_goes_as_far():
    small = replace(ROBOTS[1], diameter_m=0.12)
    start = {GHOST: Place(0, 0, 0)}
    virtual = VirtualRobots(Roster((ROBOTS[0], small)), start, VIEW, np.random.default_rng(0))
    driven(virtual, Twist(0.1, 0.0))
    assert virtual.places()[GHOST].x_m == pytest.approx(0.1 * 29 * IMAGE_S, abs=0.01)
