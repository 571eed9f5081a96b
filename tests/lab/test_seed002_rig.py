"""The rig of seed 002: markers where they should be, and the paper's method by its own formulas."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from tagmetry.geometry import RigidTransform, mahalanobis_squared
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.experiments import seed002_tilt, seed002_yaw, seed002_zones
from tagmetry.lab.experiments.seed002_zones import _looking_aside
from tagmetry.lab.rigs.localized import Estimate, Shown, errors, method_names
from tagmetry.lab.rigs.marker_floor import (
    CAMERA,
    Stand,
    angles_rad,
    camera_place,
    marker_map,
    picture,
)
from tagmetry.lab.rigs.opencv_corners import opencv_corners
from tagmetry.lab.rigs.paper_localization import fused_place

LAYOUTS = {
    "one": 1,
    "two": 2,
    "four": 4,
    "four inclined": 4,
    "four and one perpendicular": 5,
}


def pixels_of(stand: Stand, T_world_camera: RigidTransform) -> dict[int, np.ndarray]:
    """Where OpenCV projects the markers' corners to."""
    T_camera_world = T_world_camera.inv()
    turn, place = T_camera_world.rotation.as_rotvec(), np.array(T_camera_world.translation)
    return {
        one.id: cv2.projectPoints(
            np.ascontiguousarray(one.p_world), turn, place, CAMERA.matrix, np.zeros(5)
        )[0].reshape(4, 2)
        for one in marker_map(stand).markers
    }


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("yaw_deg", [0, 45, 90, 135])
@pytest.mark.parametrize("distance_m", [1.0, 7.0])
def test_every_marker_is_seen_from_its_face_at_every_yaw(
    layout: str, yaw_deg: float, distance_m: float
) -> None:
    stand = Stand(layout, distance_m, yaw_deg)
    T_world_camera = camera_place(stand, np.random.default_rng(0))
    assert len(marker_map(stand).markers) == LAYOUTS[layout]
    for one in marker_map(stand).markers:
        to_camera = T_world_camera.translation - one.T_world_marker.translation
        cosine = one.T_world_marker.rotation.as_matrix()[:, 2] @ to_camera
        assert cosine / np.linalg.norm(to_camera) > 0.5
    corners = np.concatenate(list(pixels_of(stand, T_world_camera).values()))
    assert (corners > 3).all()
    assert (corners < np.array([636, 476])).all()


def test_the_fifth_marker_is_perpendicular_to_the_others() -> None:
    markers = marker_map(Stand("four and one perpendicular", 2.0)).markers
    normals = [one.T_world_marker.rotation.as_matrix()[:, 2] for one in markers]
    np.testing.assert_allclose([normals[4] @ n for n in normals[:4]], 0, atol=1e-12)


def test_pitch_is_about_y_and_roll_about_x() -> None:
    pitched = marker_map(Stand("one", 2.0, pitch_deg=30.0)).markers[0].T_world_marker
    rolled = marker_map(Stand("one", 2.0, roll_deg=30.0)).markers[0].T_world_marker
    np.testing.assert_allclose(pitched.rotation.as_rotvec(degrees=True), [0, 30, 0], atol=1e-9)
    np.testing.assert_allclose(rolled.rotation.as_rotvec(degrees=True), [30, 0, 0], atol=1e-9)


def test_yaw_is_that_of_the_camera() -> None:
    places = [camera_place(Stand("one", 2.0, yaw), np.random.default_rng(0)) for yaw in (0, 90)]
    turned = np.degrees(angles_rad(places[1]) - angles_rad(places[0]))
    assert turned[0] == pytest.approx(90, abs=0.1)
    assert places[0].translation[2] == pytest.approx(2.0, abs=0.01)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_papers_method_finds_the_exact_place_from_exact_corners(layout: str) -> None:
    stand = Stand(layout, 2.0, 30.0)
    T_world_camera = camera_place(stand, np.random.default_rng(1))
    corners = pixels_of(stand, T_world_camera)
    for power in (1.0, 2.0):
        found = fused_place(corners, marker_map(stand), CAMERA, power)
        np.testing.assert_allclose(found.translation, T_world_camera.translation, atol=2e-5)
        np.testing.assert_allclose(angles_rad(found), angles_rad(T_world_camera), atol=2e-5)


def test_equally_far_markers_weigh_alike_and_angles_are_averaged_on_the_circle() -> None:
    """Two markers equally far off, one of which says that the camera is 30 mm aside."""
    stand = Stand("two", 1.5)
    T_world_camera = RigidTransform.from_components(
        [0, 0, 1.5], Rotation.from_euler("zx", [180, 180], degrees=True)
    )
    corners = pixels_of(stand, T_world_camera)
    places = marker_map(stand)
    near, far = places.markers
    moved = RigidTransform.from_translation([0.03, 0, 0]) * far.T_world_marker
    wrong = replace(places, markers=(near, replace(far, T_world_marker=moved)))
    found = fused_place(corners, wrong, CAMERA, 1.0)
    assert found.translation[0] == pytest.approx(0.015, abs=1e-4)  # equally far
    assert abs(np.degrees(angles_rad(found)[0])) == pytest.approx(180, abs=0.01)


@pytest.mark.parametrize("power", [1.0, 2.0])
def test_nearer_markers_weigh_more(power: float) -> None:
    """A camera above one of two markers, the other of which says that it is 30 mm aside."""
    places = marker_map(Stand("two", 1.5))
    T_world_camera = RigidTransform.from_components(
        [-0.16, 0.16, 0.3], Rotation.from_euler("x", 180, degrees=True)
    )
    far = places.markers[1]
    corners = pixels_of(Stand("two", 1.5), T_world_camera)
    moved = RigidTransform.from_translation([0.03, 0, 0]) * far.T_world_marker
    wrong = replace(places, markers=(places.markers[0], replace(far, T_world_marker=moved)))
    found = fused_place(corners, wrong, CAMERA, power)
    far_m = np.hypot(0.3, 0.32 * np.sqrt(2))
    share = far_m**-power / (far_m**-power + 0.3**-power)
    assert found.translation[0] + 0.16 == pytest.approx(0.03 * share, abs=1e-4)


def test_no_marker_no_place() -> None:
    assert fused_place({}, marker_map(Stand("one", 2.0)), CAMERA, 1.0) is None
    assert opencv_corners(np.full((480, 640), 120, np.uint8)) == {}


def test_opencv_sees_the_tags_upright() -> None:
    stand = Stand("four", 1.5, 20.0)
    T_world_camera = camera_place(stand, np.random.default_rng(2))
    seen = opencv_corners(picture(stand, T_world_camera, np.random.default_rng(2)))
    true = pixels_of(stand, T_world_camera)
    assert set(seen) == set(true)
    for marker_id, corners in true.items():
        np.testing.assert_allclose(seen[marker_id], corners, atol=0.7)


def test_errors_are_told_as_they_are() -> None:
    stand = Stand("one", 2.0)
    true = camera_place(stand, np.random.default_rng(0))
    turn = Rotation.from_euler("ZYX", [0.03, 0.0, 0.0])
    said = RigidTransform.from_components(
        true.translation + np.array([0.03, 0.04, -0.12]), turn * true.rotation
    )
    covariance = np.diag([0.01, 0.01, 0.04, 1e-4, 1e-4, 1e-4])
    found = iter([Estimate("joint", said, covariance, 0.9)])
    rows = {row.method: row for row in errors(Shown(stand, 3), true, found)}
    assert set(rows) == set(method_names())
    row = rows["joint"]
    assert row.radial_m == pytest.approx(0.13)
    assert row.xy_m == pytest.approx(0.05)
    assert row.z_m == pytest.approx(-0.12)
    assert row.angle_rad == pytest.approx(0.01)
    assert row.turn_rad == pytest.approx(0.03)
    assert row.sd_radial_m == pytest.approx(np.sqrt(0.06))
    assert row.sd_angle_rad == pytest.approx(0.01)
    error = np.array([0.03, 0.04, -0.12, 0, 0, 0.03])
    assert row.mahalanobis2 == pytest.approx(float(mahalanobis_squared(error, covariance)))
    assert np.isnan(rows["single"].radial_m)
    assert row.repeat == 3


@pytest.mark.parametrize("zone", range(9))
def test_zones_are_rows_and_columns_of_the_picture(zone: int) -> None:
    stand = Stand("one", 4.0)
    T_world_camera = _looking_aside(camera_place(stand, np.random.default_rng(zone)), zone)
    middle = pixels_of(stand, T_world_camera)[0].mean(axis=0)
    assert divmod(zone, 3) == (int(middle[1] // 160), int(middle[0] // (640 / 3)))


def test_a_case_gives_every_method_for_every_picture() -> None:
    case = seed002_yaw.Case("two", "simulator", 2.0, 45.0, 2, method_names())
    rows = seed002_yaw.measure(case, 5)
    assert [row.method for row in rows] == 2 * list(method_names())
    best = [row for row in rows if row.method == "joint"]
    assert max(row.radial_m for row in best) < 0.01
    assert str(seed002_yaw.measure(case, 5)) == str(rows)  # NaN equals none
    assert str(seed002_yaw.measure(case, 6)) != str(rows)


def test_a_leaning_marker_and_a_wrong_size_show() -> None:
    leaning = seed002_tilt.Case("roll", "webcam", 2.0, 30.0, 1, method_names())
    rows = seed002_tilt.measure(leaning, 0)
    assert {(row.pitch_deg, row.roll_deg, row.look) for row in rows} == {(0.0, 30.0, "webcam")}
    wrong = seed002_zones.measure(seed002_zones.Case(4, 1, method_names()), 0)
    off = {row.assumed: row.z_m for row in wrong if row.method == "joint"}
    assert off["right"] == pytest.approx(0, abs=0.01)
    assert off["size 2.65 % too large"] == pytest.approx(0.106, abs=0.01)
    assert off["focal length 2.65 % too long"] == pytest.approx(0.106, abs=0.01)
