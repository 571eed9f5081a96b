"""Quick pictures of robots against the exact renderer, which shares nothing with them."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from tagmetry.arena import Mount, Robot
from tagmetry.detect import Detector
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, family
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.rendering import photograph
from tagmetry.twin.robots.overhead import OverheadPictures
from tagmetry.twin.robots.roof import T_robot_marker, body_thing
from tagmetry.twin.scenes import Lamp, Light, Scene, Still, marker_thing, surface
from tagmetry.twin.scenes.path import looking
from tagmetry.twin.scenes.ready.photographer import machine_camera

FLOOR = Scene(
    (surface("floor", 6, 4, brightness=0.4),), Light(0.7, (Lamp(np.array([-1.0, 0.5, 3.0]), 2.0),))
)
ROBOTS = [
    Robot(0, "one", 0.16, "tag36h11", 0, 0.08, Mount(0.093)),
    Robot(1, "two", 0.16, "tag36h11", 1, 0.08, Mount(0.12, forward_m=0.01, turn_rad=0.3)),
    Robot(2, "at the edge", 0.16, "tag36h11", 2, 0.08, Mount(0.093)),
]
Ts_WORLD_ROBOT = RigidTransform.from_components(
    [[0.1, 0.05, 0], [-0.6, 0.4, 0], [1.75, 0.9, 0]],
    Rotation.from_euler("z", [[0.3], [2.0], [-1.0]]),
)


def shot():
    hung = machine_camera(Still(looking(np.array([0.0, 0, 2.6]), np.zeros(3))), 70.0)
    return replace(hung, optics=replace(hung.optics, veil=0.0), sensor=Sensor())


def exact():
    things = list(FLOOR.things)
    for robot, pose in zip(ROBOTS, Ts_WORLD_ROBOT, strict=True):
        marker = MountedMarker(
            robot.family, robot.marker_id, robot.marker_size_m, T_robot_marker(robot)
        )
        path = Still(pose)
        things += [replace(body_thing(robot), path=path), marker_thing([marker], path)]
    scene = replace(FLOOR, things=tuple(things))
    return photograph(scene, shot(), np.random.default_rng(0)).astype(float)


@pytest.fixture(scope="module")
def both():
    pictures = OverheadPictures(FLOOR, ROBOTS, shot())
    quick = pictures.take(Ts_WORLD_ROBOT, np.random.default_rng(0))
    return quick, exact()


def test_they_differ_by_little_anywhere(both):
    quick, true = both
    error = quick - true
    assert np.abs(error).max() < 20
    assert np.sqrt((error[error != 0] ** 2).mean()) < 5


def test_corners_lie_where_they_truly_do(both):
    detector = Detector([family("tag36h11")])
    found = {one.id: one.corners_px for one in detector.detect(both[0])}
    assert set(found) >= {0, 1}
    camera, T_camera_world = shot().camera, looking(np.array([0.0, 0, 2.6]), np.zeros(3)).inv()
    for robot, pose in list(zip(ROBOTS, Ts_WORLD_ROBOT, strict=True))[:2]:
        half = robot.marker_size_m / 2
        square = np.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]])
        p_camera = (T_camera_world * pose * T_robot_marker(robot)).apply(square)
        assert np.abs(found[robot.id] - camera.project(p_camera)).max() < 0.03


def test_a_robot_out_of_sight_changes_nothing():
    pictures = OverheadPictures(FLOOR, ROBOTS[:1], shot())
    away = RigidTransform.from_components([[9.0, 0.0, 0.0]], Rotation.identity(1))
    empty = pictures.take(away, np.random.default_rng(0))
    assert np.ptp(empty.astype(float)[300:700, 300:700]) < 60
    below = RigidTransform.from_components([[0.0, 0.0, 5.0]], Rotation.identity(1))
    np.testing.assert_array_equal(pictures.take(below, np.random.default_rng(0)), empty)
