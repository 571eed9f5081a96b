"""Projection of all lens kinds: against OpenCV, its own inverse, and finite differences."""

from dataclasses import replace

import cv2
import numpy as np
import pytest
from example_cameras import ALL_14, CAMERAS, LENSES, camera_with, points_ahead
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.errors import InputError

ZERO = np.zeros(3)
WIDE = camera_with(FisheyeLens((0.01, -0.002, 0.0005, -0.00002)))
every_camera = pytest.mark.parametrize("camera", CAMERAS.values(), ids=CAMERAS)


def opencv_projection(camera: Camera, p_camera: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return pixels and OpenCV's Jacobian by everything it knows."""
    coefficients = np.array(camera.lens.coefficients)
    if camera.lens.kind == "fisheye":
        points = p_camera.reshape(-1, 1, 3)
        pixels, jacobian = cv2.fisheye.projectPoints(
            points, ZERO, ZERO, camera.matrix, coefficients
        )
    else:
        pixels, jacobian = cv2.projectPoints(p_camera, ZERO, ZERO, camera.matrix, coefficients)
    return pixels.reshape(-1, 2), jacobian


@every_camera
def test_every_number_has_a_name_of_its_own(camera: Camera) -> None:
    names = camera.parameter_names
    assert len(set(names)) == camera.parameter_count


def test_numbers_are_called_as_opencv_does() -> None:
    assert " ".join(CAMERAS["brown5"].parameter_names) == "fx fy cx cy k1 k2 p1 p2 k3"
    assert " ".join(CAMERAS["fisheye"].parameter_names) == "fx fy cx cy k1 k2 k3 k4"


@every_camera
def test_projects_as_opencv(camera: Camera) -> None:
    expected, _ = opencv_projection(camera, points_ahead())
    np.testing.assert_allclose(camera.project(points_ahead()), expected, atol=1e-9)


@pytest.mark.parametrize("count", [4, 5, 8, 12, 14])
def test_parameter_jacobian_as_opencv(count: int) -> None:
    camera = CAMERAS[f"brown{count}"]
    _, expected = opencv_projection(camera, points_ahead())
    found = camera.parameter_jacobian(points_ahead())
    np.testing.assert_allclose(found, expected[:, 6:].reshape(-1, 2, 4 + count), atol=1e-7)


def test_parameter_jacobian_of_a_fisheye_as_opencv() -> None:
    camera = CAMERAS["fisheye"]
    _, expected = opencv_projection(camera, points_ahead())
    found = camera.parameter_jacobian(points_ahead())
    np.testing.assert_allclose(found, expected[:, :8].reshape(-1, 2, 8), atol=1e-7)


@every_camera
def test_point_jacobian_by_finite_differences(camera: Camera) -> None:
    points, step = points_ahead(), 1e-6
    pixels, found = camera.project_with_jacobian(points)
    ends = [(camera.project(points + e) - camera.project(points - e)) for e in step * np.eye(3)]
    np.testing.assert_allclose(pixels, camera.project(points))
    np.testing.assert_allclose(found, np.stack(ends, axis=-1) / (2 * step), rtol=1e-6, atol=1e-4)


@every_camera
def test_parameter_jacobian_by_finite_differences(camera: Camera) -> None:
    points, step = points_ahead(), 1e-6
    values = np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients])

    def project(parameters: np.ndarray) -> np.ndarray:
        fx, fy, cx, cy, *coefficients = map(float, parameters)
        lens = replace(camera.lens, coefficients=tuple(coefficients))
        return replace(camera, focal_px=(fx, fy), center_px=(cx, cy), lens=lens).project(points)

    ends = [project(values + e) - project(values - e) for e in step * np.eye(len(values))]
    expected = np.stack(ends, axis=-1) / (2 * step)
    found = camera.parameter_jacobian(points)
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-4)


@pytest.mark.parametrize("x_m", [0.0, 1e-14, 1e-10, 1e-7])
@pytest.mark.parametrize("kind", ["brown5", "fisheye"])
def test_jacobian_at_the_axis_is_that_of_a_pinhole(kind: str, x_m: float) -> None:
    camera = replace(CAMERAS[kind], lens=LENSES[kind])
    (fx, fy), depth_m = camera.focal_px, 2.0
    found = camera.project_with_jacobian(np.array([x_m, -x_m, depth_m]))[1]
    expected = [[fx / depth_m, 0, 0], [0, fy / depth_m, 0]]
    np.testing.assert_allclose(found, expected, atol=1e-3)


@pytest.mark.parametrize("camera", [*CAMERAS.values(), WIDE], ids=[*CAMERAS, "wide"])
def test_the_axis_itself_goes_there_and_back(camera: Camera) -> None:
    points = np.array([[0.0, 0.0, 3.0], [1e-13, 0.0, 1.0], [0.0, -1e-9, 1.0]])
    directions = points / np.linalg.norm(points, axis=-1, keepdims=True)
    if camera.lens.coefficients[12:] == ():
        np.testing.assert_allclose(camera.project(points[0]), camera.center_px)
    np.testing.assert_allclose(camera.unproject(camera.project(points)), directions, atol=1e-12)


@pytest.mark.parametrize("kind", CAMERAS)
@given(x=st.floats(-0.6, 0.6), y=st.floats(-0.6, 0.6), depth_m=st.floats(0.01, 100.0))
def test_unproject_undoes_project(kind: str, x: float, y: float, depth_m: float) -> None:
    camera, direction = CAMERAS[kind], np.array([x, y, 1.0])
    found = camera.unproject(camera.project(depth_m * direction))
    np.testing.assert_allclose(found, direction / np.linalg.norm(direction), atol=1e-9)


@given(angle_deg=st.floats(0.0, 130.0), around=st.floats(0.0, 2 * np.pi))
def test_a_fisheye_sees_behind_its_shoulder(angle_deg: float, around: float) -> None:
    angle = np.deg2rad(angle_deg)
    aside = np.sin(angle) * np.array([np.cos(around), np.sin(around)])
    direction = np.array([*aside, np.cos(angle)])
    found = WIDE.unproject(WIDE.project(0.7 * direction))
    np.testing.assert_allclose(found, direction, atol=1e-9)


def test_a_fisheye_without_coefficients_is_equidistant() -> None:
    camera = camera_with(FisheyeLens())
    angles = np.deg2rad([10.0, 80.0, 150.0])
    points = np.stack([np.sin(angles), np.zeros(3), np.cos(angles)], axis=-1)
    expected = camera.center_px[0] + camera.focal_px[0] * angles
    np.testing.assert_allclose(camera.project(points)[:, 0], expected)


def test_a_pixel_beyond_half_a_turn_has_no_ray() -> None:
    camera = camera_with(FisheyeLens())
    u = camera.center_px[0] + camera.focal_px[0] * np.array([0.99 * np.pi, 1.01 * np.pi, 4.0])
    rays = camera.unproject(np.stack([u, np.full(3, camera.center_px[1])], axis=-1))
    assert np.isfinite(rays[0]).all()
    assert np.isnan(rays[1:]).all()


@every_camera
@pytest.mark.parametrize("point", [[0, 0, -1], [0, 0, 0], [1e-12, 0, -1]])
def test_what_is_behind_is_not_seen(camera: Camera, point: list[float]) -> None:
    pixel, jacobian = camera.project_with_jacobian(np.array(point))
    assert np.isnan(pixel).all()
    assert np.isnan(jacobian).any()


@pytest.mark.parametrize("point", [[0.1, 0.2, -1.0], [1.0, 0.0, 0.0]])
def test_a_pinhole_sees_nothing_level_with_itself(point: list[float]) -> None:
    assert np.isnan(CAMERAS["brown5"].project(np.array(point))).all()


@every_camera
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_stays_nan(camera: Camera, bad: float) -> None:
    assert np.isnan(camera.project(np.array([bad, 0.1, 1.0]))).all()
    assert np.isnan(camera.unproject(np.array([[bad, 0.1], [3.0, bad]]))).all()


def test_one_bad_pixel_does_not_disturb_the_others() -> None:
    pixels = np.array([[100.0, 80.0], [np.nan, 0.0], [500.0, 300.0]])
    found = CAMERAS["brown14"].unproject(pixels)
    np.testing.assert_array_equal(np.isnan(found[:, 0]), [False, True, False])
    np.testing.assert_allclose(found[2], CAMERAS["brown14"].unproject(pixels[2]))


@every_camera
def test_leading_axes_broadcast_and_inputs_stay(camera: Camera) -> None:
    points = points_ahead(6).reshape(2, 3, 3)
    before = points.copy()
    pixels, jacobian = camera.project_with_jacobian(points)
    assert pixels.shape == (2, 3, 2)
    assert jacobian.shape == (2, 3, 2, 3)
    assert camera.parameter_jacobian(points).shape == (2, 3, 2, camera.parameter_count)
    assert camera.unproject(pixels).shape == (2, 3, 3)
    np.testing.assert_array_equal(camera.project(points[1, 2]), pixels[1, 2])
    np.testing.assert_array_equal(points, before)


def test_from_matrix_keeps_the_matrix() -> None:
    K = np.array([[700.0, 0, 320], [0, 710, 240], [0, 0, 1]])
    camera = Camera.from_matrix(640, 480, K)
    np.testing.assert_array_equal(camera.matrix, K)
    assert camera.lens == BrownLens()
    assert Camera.from_matrix(640, 480, K, LENSES["brown5"]).lens == LENSES["brown5"]


def test_an_image_reaches_half_a_pixel_beyond_its_outer_centres() -> None:
    pixels = np.array(
        [[-0.5, 0], [639.5, 479.5], [-0.51, 0], [639.51, 9], [9, 479.51], [np.nan, 9]]
    )
    found = CAMERAS["brown0"].contains(pixels)
    np.testing.assert_array_equal(found, [True, True, False, False, False, False])


def test_takes_an_image_of_its_own_size_only() -> None:
    camera = CAMERAS["brown0"]
    camera.check_image(640, 480)
    text = r"belong to 640x480 images, this one is 1280x960; .*--scale-to 1280x960"
    with pytest.raises(InputError, match=text):
        camera.check_image(1280, 960)
    with pytest.raises(InputError, match="this one is 480x640"):
        camera.check_image(480, 640)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"width_px": 0}, "image size must be positive, got 0x480"),
        ({"height_px": -1}, "image size must be positive, got 640x-1"),
        ({"focal_px": (0.0, 1.0)}, r"focal_px must be positive, got \(0.0, 1.0\)"),
        ({"focal_px": (1.0, -1.0)}, "focal_px must be positive"),
        ({"focal_px": (np.nan, 1.0)}, "focal_px must be positive"),
        ({"focal_px": (1.0, np.inf)}, "focal_px must be positive"),
        ({"center_px": (np.nan, 1.0)}, "center_px must be finite"),
        ({"zoom": 0.0}, "zoom must be positive, got 0"),
        ({"zoom": np.nan}, "zoom must be positive"),
        ({"covariance": np.eye(9)}, r"covariance of shape \(4, 4\) .* got \(9, 9\)"),
    ],
)
def test_refuses_intrinsics_that_are_none(change: dict[str, object], text: str) -> None:
    with pytest.raises(InputError, match=text):
        replace(CAMERAS["brown0"], **change)


def test_refuses_a_matrix_of_another_shape() -> None:
    with pytest.raises(InputError, match=r"3x3 camera matrix, got shape \(3, 4\)"):
        Camera.from_matrix(640, 480, np.zeros((3, 4)))


@pytest.mark.parametrize("count", [1, 2, 3, 6, 13, 15])
def test_refuses_a_number_of_coefficients_that_opencv_has_not(count: int) -> None:
    with pytest.raises(InputError, match=rf"0, 4, 5, 8, 12 or 14 .* got {count}"):
        BrownLens((0.0,) * count)


def test_refuses_a_fisheye_with_five_coefficients() -> None:
    with pytest.raises(InputError, match="a fisheye lens has 4 distortion coefficients, got 5"):
        FisheyeLens(ALL_14[:5])


@pytest.mark.parametrize("lens", [BrownLens, FisheyeLens])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_refuses_coefficients_that_are_not_finite(lens: type, bad: float) -> None:
    with pytest.raises(InputError, match="coefficients must be finite"):
        lens((0.0, bad, 0.0, 0.0))


@pytest.mark.parametrize("distance_px", [1e4, 1e9, 1e100, 1e300])
def test_fisheye_shows_nothing_at_pixels_far_outside(distance_px):
    far = np.array([[distance_px, 0.0], [-distance_px, distance_px]])
    assert np.isnan(CAMERAS["fisheye"].unproject(far)).all()
