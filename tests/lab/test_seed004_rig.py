"""The rig of seed 004: markers and robots where they should be, light as the cameras see it."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from tagmetry.geometry import RigidTransform
from tagmetry.lab.experiments import seed004_backlight, seed004_distance, seed004_repeat
from tagmetry.lab.rigs.robot_cameras import CAMERAS, robot_picture
from tagmetry.lab.rigs.robot_localized import (
    FoundRobot,
    _aruco_corners,
    _errors,
    robot_methods,
    robots,
)
from tagmetry.lab.rigs.robot_room import (
    PLACES,
    T_ROBOT_CAMERA,
    RobotStand,
    robot_place,
    room_map,
    room_scene,
)
from tagmetry.localize import PlanarPose

RNG = np.random.default_rng(0)
CORNER = RobotStand("corner", 0.16)


def corners_px(stand, camera, seed=0):
    """Where OpenCV projects the markers' corners to, by id, and whether each shows its face."""
    T_camera_world = (robot_place(stand, np.random.default_rng(seed)) * T_ROBOT_CAMERA).inv()
    K = CAMERAS[camera].camera.matrix
    turn, place = T_camera_world.rotation.as_rotvec(), np.array(T_camera_world.translation)
    return {
        one.id: cv2.projectPoints(np.ascontiguousarray(one.p_world), turn, place, K, np.zeros(5))[
            0
        ].reshape(4, 2)
        for one in room_map(stand).markers
    }


def is_whole(square, camera):
    size = np.array(CAMERAS[camera].camera.size_px)
    quiet = 0.7 * np.linalg.norm(square[0] - square[1]) / 7
    return bool((square > quiet).all() and (square < size - 1 - quiet).all())


def faces(square):
    """Say whether the corners go clockwise in the picture."""
    (x0, y0), (x1, y1), _, (x3, y3) = square
    return (x1 - x0) * (y3 - y0) - (y1 - y0) * (x3 - x0) > 0


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("distance_m", [0.2, 1.5])
def test_a_marker_before_the_robot_is_seen_whole_and_upright(camera, distance_m):
    (square,) = corners_px(RobotStand("one", 0.1, distance_m), camera).values()
    assert is_whole(square, camera)
    assert faces(square)
    assert square[0, 0] < square[1, 0]  # top left is left
    assert square[0, 1] < square[3, 1]  # and above
    side_px = CAMERAS[camera].camera.focal_px[0] * 0.1 / distance_m
    assert np.linalg.norm(square[1] - square[0]) == pytest.approx(side_px, rel=0.05)


def test_two_markers_are_20_cm_apart_and_fit_the_wide_view_from_20_cm():
    stand = RobotStand("two", 0.06, 0.2)
    one, two = (marker.T_world_marker.translation for marker in room_map(stand).markers)
    assert np.linalg.norm(one - two) == pytest.approx(0.2)
    assert all(is_whole(square, "HDR, wide") for square in corners_px(stand, "HDR, wide").values())
    assert not all(
        is_whole(square, "HDR, normal") for square in corners_px(stand, "HDR, normal").values()
    )


def test_in_the_corner_two_markers_share_a_wall_and_a_third_is_perpendicular():
    markers = room_map(CORNER).markers
    normals = [one.T_world_marker.rotation.as_matrix()[:, 2] for one in markers]
    assert normals[0] @ normals[1] == pytest.approx(1)
    assert normals[0] @ normals[2] == pytest.approx(0, abs=1e-12)
    assert len({one.T_world_marker.translation[2] for one in markers}) == 1


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("size_m", [0.16, 0.1])
def test_from_every_place_two_markers_are_seen_whole(place, size_m):
    stand = replace(CORNER, place=place, size_m=size_m)
    for seed in range(5):
        seen = corners_px(stand, "HDR, normal", seed).values()
        assert sum(is_whole(one, "HDR, normal") and faces(one) for one in seen) == 2
    assert PLACES[0] == PLACES[3]


def test_opencv_finds_the_markers_upright_where_they_are():
    stand, rng = replace(CORNER, place=2), np.random.default_rng(4)
    T_world_robot = robot_place(stand, rng)
    pixels = robot_picture("HDR, normal", room_scene(stand), T_world_robot * T_ROBOT_CAMERA, rng)
    seen, true = _aruco_corners(pixels), corners_px(stand, "HDR, normal", 4)
    assert len(seen) == 2
    for marker_id, square in seen.items():
        np.testing.assert_allclose(square, true[marker_id], atol=1.0)


def test_every_method_is_near_the_truth_and_ours_knows_how_near():
    stand, rng = replace(CORNER, place=1), np.random.default_rng(5)
    T_world_robot = robot_place(stand, rng)
    pixels = robot_picture("HDR, normal", room_scene(stand), T_world_robot * T_ROBOT_CAMERA, rng)
    found = list(robots(pixels, room_map(stand), CAMERAS["HDR, normal"].camera))
    assert [one.method for one in found] == list(robot_methods())
    for one in found:
        errors = _errors(one, T_world_robot)
        assert np.hypot(errors["x_m"], errors["y_m"]) < (0.03 if one.method == "paper" else 0.003)
        assert one.method == "paper" or errors["mahalanobis2"] < 20


def test_errors_are_told_as_they_are():
    from tagmetry.geometry.transforms import Rotation

    true = RigidTransform.from_components([1, 2, 0], Rotation.from_euler("z", 179, degrees=True))
    said = PlanarPose(1.03, 1.96, np.radians(-179), np.diag([4e-4, 5e-4, 1e-2]))
    errors = _errors(FoundRobot("joint", said, 2), true)
    assert (errors["x_m"], errors["y_m"]) == (pytest.approx(0.03), pytest.approx(-0.04))
    assert np.degrees(errors["heading_rad"]) == pytest.approx(2)
    assert errors["sd_place_m"] == pytest.approx(0.03)
    assert errors["sd_heading_rad"] == pytest.approx(0.1)
    turn2 = np.radians(2) ** 2 / 1e-2
    assert errors["mahalanobis2"] == pytest.approx(9e-4 / 4e-4 + 16e-4 / 5e-4 + turn2)
    assert np.isnan(_errors(None, true)["x_m"])


@pytest.mark.parametrize("camera", ["webcam", "HDR, normal"])
def test_windows_leave_the_pillar_dark_only_where_the_camera_exposes_by_itself(camera):
    stand = RobotStand("one", 0.1, 1.0, window=100.0)
    T_world_camera = robot_place(stand, RNG) * T_ROBOT_CAMERA
    pixels = robot_picture(camera, room_scene(stand), T_world_camera, RNG)
    middle, left = pixels[100:150].mean(axis=0)[pixels.shape[1] // 2], pixels[:, :50].mean()
    assert left > 100
    assert (middle < 15) == (camera == "webcam")
    if camera == "webcam":
        assert pixels.mean() / 255 == pytest.approx(0.45, abs=0.01)


def test_a_case_gives_every_method_for_every_picture():
    case = seed004_distance.Case("HDR, wide", "two", 0.06, 0.5, 2, robot_methods())
    rows = seed004_distance.measure(case, 3)
    assert [row.method for row in rows] == 2 * list(robot_methods())
    assert {row.markers for row in rows} <= {1, 2}
    assert str(seed004_distance.measure(case, 3)) == str(rows)


def test_cases_are_those_of_the_paper():
    cases = seed004_distance.cases(quick=False)
    large = {one.distance_m for one in cases if one.size_m == 0.1}
    np.testing.assert_allclose(sorted(large), np.arange(0.2, 1.51, 0.1))
    assert {one.camera for one in cases if one.size_m == 0.1} == set(CAMERAS)
    assert {one.size_m for one in seed004_repeat.cases(quick=True)} == {0.16, 0.1}
    for module in (seed004_distance, seed004_backlight, seed004_repeat):
        assert len(module.cases(quick=True)) <= len(module.cases(quick=False))
    assert max(one.window for one in seed004_backlight.cases(quick=True)) == 100
