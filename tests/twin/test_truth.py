"""The truth of a picture against closed forms and the estimators' own camera model."""

import json

import numpy as np
import pytest

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import CharucoBoard, MountedMarker, marker_corners_m
from tagmetry.twin import Optics, Scene, Shot, Shutter
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.rendering import DigitalZoom
from tagmetry.twin.scenes import Steady, Still, board_thing, marker_thing, surface
from tagmetry.twin.truth import MarkerTruth, image_truth, truth_line

CAMERA = Camera(640, 480, (500.0, 500.0), (319.5, 239.5))
FACING = Rotation.from_euler("x", 180, degrees=True)
HERE = Still(RigidTransform.identity())


def at(x_m: float, y_m: float, z_m: float, turn: Rotation = FACING) -> RigidTransform:
    return RigidTransform.from_components([x_m, y_m, z_m], turn)


def marker(T_camera_marker: RigidTransform, size_m: float = 0.2) -> MountedMarker:
    return MountedMarker("tag36h11", 5, size_m, T_camera_marker)


def truth_of(scene: Scene, **shot: object) -> MarkerTruth:
    (one,) = image_truth(scene, Shot(**{"camera": CAMERA, "path": HERE, **shot})).markers
    return one


def alone(T_camera_marker: RigidTransform, **shot: object) -> MarkerTruth:
    return truth_of(Scene((marker_thing([marker(T_camera_marker)]),)), **shot)


LENSES = {
    "pinhole": BrownLens(),
    "brown": BrownLens((-0.25, 0.08, 0.001, -0.002, 0.0)),
    "rational": BrownLens((0.3, -0.1, 0.001, 0.0, 0.0, 0.5, -0.1, 0.0)),
    "fisheye": FisheyeLens((0.02, -0.01, 0.003, 0.0)),
}


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES)
def test_corners_are_where_the_camera_model_projects_them(lens: BrownLens) -> None:
    camera = Camera(640, 480, (500.0, 510.0), (321.0, 236.0), lens)
    T_world_camera = at(0.3, -0.2, 0.1, Rotation.from_rotvec([0.1, -0.2, 0.05]))
    T_world_marker = at(0.4, -0.3, 1.4, Rotation.from_rotvec([2.9, 0.3, 0.2]))
    scene = Scene((marker_thing([marker(T_world_marker)]),))
    one = truth_of(scene, camera=camera, path=Still(T_world_camera))
    T_camera_marker = T_world_camera.inv() * T_world_marker
    expected = camera.project(T_camera_marker.apply(marker_corners_m(0.2)))
    np.testing.assert_allclose(one.corners_px, expected, atol=1e-9)
    np.testing.assert_allclose(one.T_camera_marker.as_matrix(), T_camera_marker.as_matrix())


def test_a_boards_corners_are_where_the_camera_model_projects_them() -> None:
    board = CharucoBoard(7, 5, 0.03, 0.022)
    camera = Camera(640, 480, (500.0, 500.0), (319.5, 239.5), LENSES["brown"])
    T_camera_board = at(0.02, 0.01, 0.5, Rotation.from_rotvec([2.9, 0.3, 0.2]))
    truth = image_truth(Scene((board_thing(board, Still(T_camera_board)),)), Shot(camera, HERE))
    (one,) = truth.boards
    expected = camera.project(T_camera_board.apply(board.corners_m))
    np.testing.assert_allclose(one.corners_px, expected, atol=1e-9)
    assert len(truth.markers) == 17
    assert all(m.visible_fraction == pytest.approx(1, abs=1e-6) for m in truth.markers)


def test_the_numbers_of_a_marker() -> None:
    lens = ThinLens(0.008, 0.004, 4e-6)
    T_camera_marker = at(0.0, 0.3, 0.4, Rotation.from_euler("x", 180, degrees=True))
    one = alone(T_camera_marker, optics=Optics(lens=lens, focus_m=0.2))
    assert (one.distance_m, one.depth_m) == pytest.approx((0.5, 0.4))
    assert one.tilt_deg == pytest.approx(np.degrees(np.arctan2(0.3, 0.4)))
    assert one.side_px == pytest.approx(500 * 0.2 / 0.4)
    sensor_m = 1 / (1 / 0.008 - 1 / 0.2)
    diameter_px = 0.004 * sensor_m * (1 / 0.2 - 1 / 0.4) / 4e-6
    assert one.disc_px == pytest.approx(diameter_px / 2)


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 0.813])
def test_out_of_the_image_by_a_share(share: float) -> None:
    """The image ends at u = -0.5, half a pixel beyond its first pixels' centres."""
    left_m = (-0.5 - CAMERA.center_px[0]) / 500
    one = alone(at(left_m + (0.5 - share) * 0.2, 0.0123, 1.0))
    assert one.visible_fraction == pytest.approx(1 - share, abs=1e-9)
    assert np.isfinite(one.corners_px).all()


@pytest.mark.parametrize("share", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_hidden_by_a_nearer_sheet_by_a_share(share: float) -> None:
    """The cover stands at half the distance, so that it hides twice its width."""
    edge_m = -0.1 + 0.2 * share
    cover = surface("cover", 1.0, 1.0, Still(at(edge_m / 2 - 0.5, 0.01, 0.5)))
    scene = Scene((cover, marker_thing([marker(at(0.0, 0.0, 1.0))])))
    assert truth_of(scene).visible_fraction == pytest.approx(1 - share, abs=1e-6)


def test_a_farther_sheet_hides_nothing() -> None:
    wall = surface("wall", 3.0, 3.0, Still(at(0.0, 0.0, 2.0)))
    scene = Scene((marker_thing([marker(at(0.0, 0.0, 1.0))]), wall))
    assert truth_of(scene).visible_fraction == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(
    "T_camera_marker",
    [at(0, 0, 1, Rotation.identity()), at(0, 0, -1), at(3, 0, 1)],
    ids=["turned away", "behind the camera", "beside the image"],
)
def test_what_is_not_seen_at_all(T_camera_marker: RigidTransform) -> None:
    one = alone(T_camera_marker)
    assert one.visible_fraction == 0.0
    assert np.isnan(one.corners_px).all() == (one.depth_m < 0)


def test_a_marker_at_a_slant_is_wholly_visible() -> None:
    turn = Rotation.from_euler("xy", [180, 70], degrees=True)
    one = alone(at(0.03, 0.02, 0.8, turn), camera=Camera(640, 480, (500, 500), (319.5, 239.5)))
    assert one.visible_fraction == pytest.approx(1.0, abs=2e-5)


def rays_through(random: Array, one: MountedMarker) -> Array:
    """Return random points of a marker in its camera's frame, shape (n, 3)."""
    p_marker = np.column_stack([(random - 0.5) * one.size_m, np.zeros(len(random))])
    return np.asarray(one.T_body_marker.apply(p_marker))


def hidden_by(p_camera: Array, T_camera_sheet: RigidTransform, half_m: float) -> Array:
    """Say whether a square sheet stands between the camera's centre and points."""
    R, t = T_camera_sheet.rotation.as_matrix(), T_camera_sheet.translation
    reach = (R[:, 2] @ t) / (p_camera @ R[:, 2])
    on_sheet = (reach[:, None] * p_camera - t) @ R
    within = np.abs(on_sheet[:, :2]).max(axis=1) < half_m
    return within & (reach > 0) & (reach < 1)


@pytest.mark.parametrize("seed", range(6))
def test_visibility_is_that_of_rays_cast_at_random_points(seed: int) -> None:
    rng = np.random.default_rng(seed)
    one = marker(at(*rng.uniform(-0.4, 0.4, 2), 1.2, Rotation.from_euler("xy", [200, 20], True)))
    covers = [
        at(*rng.uniform(-0.15, 0.15, 2), 0.6, Rotation.from_rotvec([np.pi, *rng.normal(0, 0.2, 2)]))
        for _ in range(3)
    ]
    things = [surface(f"{i}", 0.1, 0.1, Still(T)) for i, T in enumerate(covers)]
    found = truth_of(Scene((*things, marker_thing([one])))).visible_fraction
    p_camera = rays_through(rng.random((200_000, 2)), one)
    shown = CAMERA.contains(CAMERA.project(p_camera))
    for cover in covers:
        shown &= ~hidden_by(p_camera, cover, 0.05)
    assert found == pytest.approx(shown.mean(), abs=4e-3)


def test_a_rolling_shutter_shears_a_passing_square() -> None:
    """With x(t) = x0 + s t and t = (v - v0) line: u = cx + f (x0 + s (v - v0) line) / z."""
    speed_m_s, line_s = 1.5, 20e-6
    path = Steady(RigidTransform.identity(), np.array([-speed_m_s, 0.0, 0.0]), np.zeros(3))
    one = alone(at(0.05, 0.1, 1.0), path=path, shutter=Shutter(0.0, line_s))
    x_m, y_m, _ = (at(0.05, 0.1, 1.0).apply(marker_corners_m(0.2))).T
    v = 239.5 + 500 * y_m
    u = 319.5 + 500 * (x_m + speed_m_s * (v - 239.5) * line_s)
    np.testing.assert_allclose(one.corners_px, np.column_stack([u, v]), atol=1e-9)


def test_a_rolling_shutter_stretches_a_square_that_falls() -> None:
    """v = v0 + f (y + s (v - v0) line): a fixed point with the factor 1 / (1 - f s line)."""
    speed_m_s, line_s = 2.0, 50e-6
    path = Steady(RigidTransform.identity(), np.array([0.0, -speed_m_s, 0.0]), np.zeros(3))
    one = alone(at(0.0, 0.05, 1.0), path=path, shutter=Shutter(0.0, line_s))
    y_m = at(0.0, 0.05, 1.0).apply(marker_corners_m(0.2))[:, 1]
    v = 239.5 + 500 * y_m / (1 - 500 * speed_m_s * line_s)
    np.testing.assert_allclose(one.corners_px[:, 1], v, atol=1e-9)


def test_motion_blur_leaves_the_middle_of_the_exposure() -> None:
    path = Steady(RigidTransform.identity(), np.array([1.0, 0.0, 0.0]), np.zeros(3))
    moving = alone(at(0, 0, 1), path=path, shutter=Shutter(0.02), time_s=0.1)
    still = alone(at(-0.1, 0, 1))
    np.testing.assert_allclose(moving.corners_px, still.corners_px, atol=1e-9)


def test_a_digital_zoom_moves_corners_and_cuts_markers_off() -> None:
    """Zoomed by 2 and halved in size: the middle half of the sensor at its own scale."""
    edge_m = (160 - 0.5 - 319.5) / 500  # the window begins half a pixel before column 160
    zoom = DigitalZoom(2.0, 320, 240)
    whole, one = alone(at(edge_m, 0, 1)), alone(at(edge_m, 0, 1), zoom=zoom)
    np.testing.assert_allclose(one.corners_px, whole.corners_px - [160, 120], atol=1e-9)
    assert (whole.visible_fraction, one.visible_fraction) == pytest.approx((1.0, 0.5), abs=1e-9)


def test_what_a_lens_folds_back_is_not_seen() -> None:
    camera = Camera(640, 480, (500.0, 500.0), (319.5, 239.5), BrownLens((-0.4, 0.0, 0.0, 0.0)))
    one = alone(at(2.0, 0.0, 1.0), camera=camera)
    assert np.isnan(one.corners_px).all()
    assert one.visible_fraction == 0.0


def test_a_line_is_exact_and_holds_only_finite_numbers() -> None:
    turn = Rotation.from_rotvec([3.0, 0.1, 0.2])
    scene = Scene((marker_thing([marker(at(0.01, 0.02, 0.7, turn)), marker(at(0, 0, -1))]),))
    truth = image_truth(scene, Shot(CAMERA, HERE, time_s=0.1))
    line = json.loads(truth_line(truth, "000003.png", 3), parse_constant=pytest.fail)
    assert (line["source"], line["sequence"], line["time_s"]) == ("000003.png", 3, 0.1)
    seen, behind = line["markers"]
    np.testing.assert_array_equal(seen["corners_px"], truth.markers[0].corners_px)
    assert behind["corners_px"] == [[None, None]] * 4
    assert behind["side_px"] is None
    pose = seen["T_camera_marker"]
    back = RigidTransform.from_components(
        pose["translation_m"], Rotation.from_quat(pose["rotation_xyzw"])
    )
    found = Camera.project(CAMERA, back.apply(marker_corners_m(0.2)))
    np.testing.assert_allclose(found, seen["corners_px"], atol=1e-9)
