"""A changed camera projects where the changed image shows it."""

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np
import pytest
from example_cameras import ALL_14, CAMERAS, HEIGHT_PX, LENSES, WIDTH_PX, camera_with, points_ahead

from tagmetry.camera import BrownLens, Camera, FisheyeLens, cropped, rotated, scaled, zoomed
from tagmetry.errors import InputError

TURNABLE = [name for name in LENSES if name != "brown14"]
Change = Callable[[Camera], Camera]
PixelMap = Callable[[np.ndarray], np.ndarray]
CHANGES: dict[str, tuple[Change, PixelMap]] = {
    "scaled": (
        lambda camera: scaled(camera, 320, 120),
        lambda p: (p + 0.5) * [0.5, 0.25] - 0.5,
    ),
    "cropped": (lambda camera: cropped(camera, 100, -20, 300, 200), lambda p: p - [100, -20]),
    "zoomed": (
        lambda camera: zoomed(camera, 2.5),
        lambda p: (p - [319.5, 239.5]) * 2.5 + [319.5, 239.5],
    ),
    "turned 1": (
        lambda camera: rotated(camera, 1),
        lambda p: np.stack([HEIGHT_PX - 1 - p[..., 1], p[..., 0]], axis=-1),
    ),
    "turned 2": (lambda camera: rotated(camera, 2), lambda p: [WIDTH_PX - 1, HEIGHT_PX - 1] - p),
    "turned 3": (
        lambda camera: rotated(camera, -1),
        lambda p: np.stack([p[..., 1], WIDTH_PX - 1 - p[..., 0]], axis=-1),
    ),
}
SIZES = {
    "scaled": (320, 120), "cropped": (300, 200), "zoomed": (640, 480),
    "turned 1": (480, 640), "turned 2": (640, 480), "turned 3": (480, 640),
}  # fmt: skip
CASES = [
    (change, lens)
    for change in CHANGES
    for lens in (TURNABLE if change.startswith("turned") else LENSES)
]


def turned_into_the_new_camera(change: str, points: np.ndarray) -> np.ndarray:
    """Return the points in the frame of the changed camera: only a turn moves them."""
    quarters = int(change.removeprefix("turned")) if change.startswith("turned") else 0
    for _ in range(quarters):
        points = points[:, [1, 0, 2]] * [-1, 1, 1]
    return points


@pytest.mark.parametrize(("change", "lens"), CASES)
def test_the_changed_camera_projects_where_the_pixel_went(change: str, lens: str) -> None:
    make, move = CHANGES[change]
    changed = make(CAMERAS[lens])
    found = changed.project(turned_into_the_new_camera(change, points_ahead()))
    np.testing.assert_allclose(found, move(CAMERAS[lens].project(points_ahead())), atol=1e-9)
    assert changed.size_px == SIZES[change]


@pytest.mark.parametrize(("change", "lens"), CASES)
def test_the_covariance_follows_the_parameters(change: str, lens: str) -> None:
    make, _ = CHANGES[change]
    camera = CAMERAS[lens]
    n = camera.parameter_count
    root = np.random.default_rng(n).normal(size=(n, n))
    changed = make(replace(camera, covariance=root @ root.T))

    def parameters_after(step: np.ndarray) -> np.ndarray:
        values = np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients]) + step
        fx, fy, cx, cy, *coefficients = map(float, values)
        moved_lens = replace(camera.lens, coefficients=tuple(coefficients))
        moved = make(replace(camera, focal_px=(fx, fy), center_px=(cx, cy), lens=moved_lens))
        return np.array([*moved.focal_px, *moved.center_px, *moved.lens.coefficients])

    J = np.stack([parameters_after(e) - parameters_after(-e) for e in np.eye(n) / 2], axis=-1)
    np.testing.assert_allclose(changed.covariance, J @ root @ root.T @ J.T, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("change", CHANGES)
def test_no_covariance_stays_none(change: str) -> None:
    assert CHANGES[change][0](CAMERAS["brown5"]).covariance is None


def spot(u: int, v: int, width: int = 48, height: int = 32) -> np.ndarray:
    pixels = np.zeros((height, width), np.float32)
    pixels[v, u] = 1.0
    return pixels


def spot_center(pixels: np.ndarray) -> np.ndarray:
    v, u = np.indices(pixels.shape)
    return np.array([(u * pixels).sum(), (v * pixels).sum()]) / pixels.sum()


def small_camera() -> Camera:
    return Camera(48, 32, (40.0, 44.0), (22.0, 17.0))


def ray_of(camera: Camera, u: float, v: float) -> np.ndarray:
    return camera.unproject(np.array([float(u), float(v)]))


@pytest.mark.parametrize(("width", "height"), [(24, 16), (12, 8), (16, 32)])
def test_scaled_agrees_with_a_resampled_image(width: int, height: int) -> None:
    """A block of pixels that fills whole cells is where half a pixel's care says."""
    block_u, block_v = 48 // width, 32 // height
    image = np.zeros((32, 48), np.float32)
    image[4 * block_v : 5 * block_v, 6 * block_u : 7 * block_u] = 1.0
    small = cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
    before = ray_of(small_camera(), *spot_center(image))
    after = ray_of(scaled(small_camera(), width, height), *spot_center(small))
    np.testing.assert_allclose(after, before, atol=1e-6)


@pytest.mark.parametrize("quarters", [0, 1, 2, 3])
def test_rotated_agrees_with_a_turned_image(quarters: int) -> None:
    camera, turned_camera = small_camera(), rotated(small_camera(), quarters)
    turned = np.rot90(spot(9, 5), -quarters)
    before = ray_of(camera, 9, 5)[None]
    after = ray_of(turned_camera, *spot_center(turned))
    expected = turned_into_the_new_camera(f"turned {quarters}", before)[0]
    np.testing.assert_allclose(after, expected, atol=1e-12)
    assert turned_camera.size_px == turned.shape[::-1]


def test_cropped_agrees_with_a_cut_image() -> None:
    cut = spot(19, 15)[10:30, 12:40]
    after = ray_of(cropped(small_camera(), 12, 10, 28, 20), *spot_center(cut))
    np.testing.assert_allclose(after, ray_of(small_camera(), 19, 15), atol=1e-12)


def test_zoomed_agrees_with_an_image_cut_and_blown_up() -> None:
    middle = spot(26, 15)[8:24, 12:36]
    blown_up = cv2.resize(middle, (48, 32), interpolation=cv2.INTER_NEAREST)
    changed = zoomed(small_camera(), 2.0)
    np.testing.assert_allclose(
        ray_of(changed, *spot_center(blown_up)), ray_of(small_camera(), 26, 15), atol=1e-12
    )
    assert changed.zoom == 2.0
    assert zoomed(changed, 1.5).zoom == 3.0


@pytest.mark.parametrize("lens", TURNABLE)
def test_four_quarters_change_nothing(lens: str) -> None:
    camera = camera_with(LENSES[lens])
    turned = rotated(rotated(camera, 3), 5)
    again = rotated(turned, 0)
    assert again.size_px == camera.size_px
    np.testing.assert_allclose(again.matrix, camera.matrix)
    np.testing.assert_allclose(again.lens.coefficients, camera.lens.coefficients)


def test_a_lens_with_an_untilted_sensor_turns_all_the_same() -> None:
    """p1' = p2, tx' = -ty, ty' = tx: their covariances go along."""
    covariance = np.diag(np.arange(1.0, 19))
    covariance[16:, 7] = covariance[7, 16:] = 0.2, 0.3  # tilts with p2
    camera = camera_with(BrownLens((*ALL_14[:12], 0.0, 0.0)), covariance)
    turned = rotated(camera, 1)
    assert len(turned.lens.coefficients) == 14
    np.testing.assert_allclose(np.diag(turned.covariance)[-2:], [18.0, 17.0])
    np.testing.assert_allclose(np.asarray(turned.covariance)[-2:, 6], [-0.3, 0.2])
    np.testing.assert_allclose(
        turned.project(turned_into_the_new_camera("turned 1", points_ahead())),
        CHANGES["turned 1"][1](camera.project(points_ahead())),
    )


def test_scaling_there_and_back_changes_nothing() -> None:
    camera = replace(CAMERAS["fisheye"], covariance=np.eye(8))
    again = scaled(scaled(camera, 1920, 960), WIDTH_PX, HEIGHT_PX)
    np.testing.assert_allclose(again.matrix, camera.matrix)
    np.testing.assert_allclose(again.covariance, camera.covariance)


def test_cropping_leaves_the_covariance() -> None:
    camera = replace(CAMERAS["fisheye"], covariance=np.eye(8))
    np.testing.assert_array_equal(cropped(camera, 3, 4, 50, 60).covariance, np.eye(8))


def test_refuses_to_turn_a_tilted_sensor() -> None:
    with pytest.raises(InputError, match=r"tilted sensor .* cannot be turned exactly"):
        rotated(CAMERAS["brown14"], 1)


@pytest.mark.parametrize("factor", [0.99, 0.0, -1.0, np.nan, np.inf])
def test_refuses_a_digital_zoom_below_one(factor: float) -> None:
    with pytest.raises(InputError, match="a digital zoom is at least 1, got"):
        zoomed(CAMERAS["brown0"], factor)


@pytest.mark.parametrize(("width", "height"), [(0, 10), (10, 0), (-5, 10)])
def test_refuses_an_image_without_pixels(width: int, height: int) -> None:
    with pytest.raises(InputError, match="image size must be positive"):
        scaled(CAMERAS["brown0"], width, height)
    with pytest.raises(InputError, match="image size must be positive"):
        cropped(CAMERAS["brown0"], 0, 0, width, height)


def test_a_fisheye_stays_itself_when_turned() -> None:
    assert rotated(camera_with(FisheyeLens()), 1).lens == FisheyeLens()
