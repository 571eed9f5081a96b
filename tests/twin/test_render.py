"""The rendered picture against closed forms that share nothing with the renderer.

Black markers with a black quiet zone are plain squares; their edges have known places.
"""

import time

import numpy as np
import pytest
from scipy.special import erf

from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, marker_corners_m
from tagmetry.twin import Look, render, showcase

CAMERA = Camera(240, 200, (400.0, 400.0), (119.5, 99.5))
FACING = Rotation.from_euler("x", 180, degrees=True)
FLAT = Look(black=20, white=220, background=120, blur_px=0, noise=0)
PLAIN = Look(black=220, white=220, background=20, blur_px=0, noise=0)  # a white square
CELLS = 8  # along the black square of tag36h11; a quiet cell on either side


def marker(T_camera_marker: RigidTransform, side_m: float, number: int = 0) -> MountedMarker:
    """A marker whose paper, quiet zone included, has the given side."""
    return MountedMarker("tag36h11", number, side_m * CELLS / (CELLS + 2), T_camera_marker)


def picture(markers: list[MountedMarker], look: Look, camera: Camera = CAMERA) -> Array:
    rng = np.random.default_rng(0)
    return render(markers, RigidTransform.identity(), camera, rng, look).astype(float)


def facing(x_m: float, y_m: float, z_m: float, turn: Rotation = FACING) -> RigidTransform:
    return RigidTransform.from_components([x_m, y_m, z_m], turn)


@pytest.mark.parametrize("shift_px", [0.0, 0.21, 0.5, 0.83])
def test_an_axis_parallel_square_covers_its_share_of_every_pixel(shift_px: float) -> None:
    """Coverage is a product of the overlaps along x and y."""
    side_px, middle_px = 61.3, np.array([110 + shift_px, 95 - shift_px / 2])
    x_m, y_m = (middle_px - CAMERA.center_px) / 400.0
    white = picture([marker(facing(x_m, y_m, 1.0), side_px / 400.0)], PLAIN)

    def overlap(count: int, middle: float) -> Array:
        pixels = np.arange(count)
        low = np.maximum(pixels - 0.5, middle - side_px / 2)
        return np.clip(np.minimum(pixels + 0.5, middle + side_px / 2) - low, 0, None)

    share = np.outer(overlap(200, middle_px[1]), overlap(240, middle_px[0]))
    found = (white - 20) / 200
    np.testing.assert_allclose(found, share, atol=0.51 / 200)  # rounding to whole grey values


def edge_places_px(grey: Array, rows: slice) -> Array:
    """Where a dark square on white begins in each row, by the area that is missing."""
    dark = (grey.max() - grey[rows]) / np.ptp(grey)
    middle = grey.shape[1] // 2
    return middle + 0.5 - dark[:, : middle + 1].sum(axis=1)


@pytest.mark.parametrize("blur_px", [0.0, 0.7])
@pytest.mark.parametrize("lens", [BrownLens(), BrownLens((-0.3, 0.1, 0.002, -0.001))])
def test_edges_stand_where_the_camera_projects_them(lens: BrownLens, blur_px: float) -> None:
    camera = Camera(240, 200, (300.0, 300.0), (119.5, 99.5), lens)
    look = Look(black=20, white=20, background=220, blur_px=blur_px, noise=0)
    T_camera_marker = facing(
        0.004, 0.003, 0.5, Rotation.from_euler("xyz", [180, 21, 2], degrees=True)
    )
    grey = picture([marker(T_camera_marker, 0.2)], look, camera)
    along = np.linspace(-0.1, 0.1, 2001)
    edge = np.stack([np.full_like(along, -0.1), along, np.zeros_like(along)], axis=-1)
    u, v = camera.project(T_camera_marker.apply(edge)).T
    order = np.argsort(v)
    rows = np.arange(int(v.min()) + 6, int(v.max()) - 5)
    expected = np.interp(rows, v[order], u[order])
    found = edge_places_px(grey, slice(rows[0], rows[-1] + 1))
    error = found - expected
    assert abs(error.mean()) < 0.001
    assert np.abs(error).max() < 0.012  # a single row shows the 200 grey values
    if lens.coefficients and any(lens.coefficients):
        line = np.polynomial.Polynomial.fit(rows, expected, 1)(rows)
        assert np.abs(expected - line).max() > 0.2  # the edge does bow


@pytest.mark.parametrize("blur_px", [0.4, 0.6, 1.0, 2.0])
def test_a_blurred_edge_is_a_gaussians_integral(blur_px: float) -> None:
    """The profile is the mean over a pixel of (1 + erf(t / (sigma sqrt 2))) / 2."""
    look = Look(black=220, white=220, background=20, blur_px=blur_px, noise=0)
    side_px = 80.4
    white = picture([marker(facing(0, 0, 1.0), side_px / 400.0)], look)
    row = (white[100, :119] - 20) / 200
    within = (np.arange(200) + 0.5) / 200 - 0.5
    distance_px = np.arange(119)[:, None] + within - (119.5 - side_px / 2)
    profile = (1 + erf(distance_px / (blur_px * np.sqrt(2)))).mean(axis=1) / 2
    np.testing.assert_allclose(row, profile, atol=0.0055)  # of which rounding 0.0025


def test_noise_has_the_variance_that_was_asked_for() -> None:
    grey = picture([], Look(noise=3.0))
    assert grey.mean() == pytest.approx(120, abs=5 * 3 / np.sqrt(grey.size))
    assert grey.var() == pytest.approx(9 + 1 / 12, rel=0.04)
    neighbours = np.corrcoef(grey[:, :-1].ravel(), grey[:, 1:].ravel())[0, 1]
    assert abs(neighbours) < 0.03  # the blur is the lens's, not the sensor's


def test_the_nearest_marker_hides_the_farther_in_either_order() -> None:
    near = marker(facing(0.0, 0.0, 0.5), 0.1, number=1)
    far = marker(facing(0.0, 0.0, 1.0), 0.4, number=2)
    both = picture([near, far], FLAT)
    np.testing.assert_array_equal(both, picture([far, near], FLAT))
    middle = (slice(62, 137), slice(82, 157))  # within the near one's 80 pixels
    np.testing.assert_array_equal(both[middle], picture([near], FLAT)[middle])
    around = (slice(25, 55), slice(45, 195))
    np.testing.assert_array_equal(both[around], picture([far], FLAT)[around])


@pytest.mark.parametrize(
    "T_camera_marker",
    [
        facing(0, 0, -1.0),
        facing(0, 0, -1.0, Rotation.identity()),
        facing(0, 0, 1.0, Rotation.identity()),
        facing(5.0, 0, 1.0),
        facing(0, 0, 1.0, Rotation.from_euler("y", 90, degrees=True)),
    ],
    ids=["behind", "behind and turned", "seen from the back", "beside the image", "edge on"],
)
def test_nothing_is_drawn_of_a_marker_that_is_not_seen(T_camera_marker: RigidTransform) -> None:
    assert (picture([marker(T_camera_marker, 0.2)], FLAT) == 120).all()


def test_a_marker_over_the_border_is_cut_off() -> None:
    inside = picture([marker(facing(0.0, 0.0, 1.0), 0.2)], FLAT)
    moved = picture([marker(facing(0.25, 0.0, 1.0), 0.2)], FLAT)  # 100 pixels to the right
    np.testing.assert_array_equal(moved[:, 100:], inside[:, :140])


def test_cells_are_the_markers_upright_and_turned() -> None:
    from tagmetry.markers import family

    cell_px = 12
    side_px = cell_px * (CELLS + 2)
    upright = marker(facing(0.0, 0.0, 1.0), side_px / 400.0, number=5)
    grey = picture([upright], FLAT)
    first = 119.5 - side_px / 2 + cell_px * 1.5
    columns = np.rint(first + cell_px * np.arange(CELLS)).astype(int)
    rows = np.rint(columns - 20).astype(int)
    read = grey[np.ix_(rows, columns)] > 120
    np.testing.assert_array_equal(read, family("tag36h11").picture(5))
    quarter = FACING * Rotation.from_euler("z", 90, degrees=True)
    turned = picture([marker(facing(0, 0, 1.0, quarter), side_px / 400.0, number=5)], FLAT)
    read = turned[np.ix_(rows, columns)] > 120
    np.testing.assert_array_equal(read, np.rot90(family("tag36h11").picture(5)))


def test_the_same_seed_gives_the_same_picture() -> None:
    scene = showcase.markers()[:1], showcase.T_camera_wall, showcase.CAMERA
    one, two, other = (render(*scene, np.random.default_rng(seed)) for seed in (3, 3, 4))
    assert one.dtype == np.uint8
    assert one.shape == (720, 1280)
    np.testing.assert_array_equal(one, two)
    assert (one != other).mean() > 0.3


def test_a_tilted_square_covers_what_its_outline_does() -> None:
    """The shoelace area of the projected outline, straight without distortion."""
    tilt = Rotation.from_euler("xyz", [180 - 40, 25, 33], degrees=True)
    T_camera_marker = facing(0.01, -0.02, 0.8, tilt)
    white = picture([marker(T_camera_marker, 0.2)], PLAIN)
    x, y = CAMERA.project(T_camera_marker.apply(marker_corners_m(0.2))).T
    area_px2 = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert ((white - 20) / 200).sum() == pytest.approx(area_px2, rel=5e-4)


def test_whole_numbers_are_colours_like_any_other() -> None:
    whole = picture([marker(facing(0, 0, 1.0), 0.2)], Look(30, 210, 120, noise=0))
    floating = picture([marker(facing(0, 0, 1.0), 0.2)], Look(30.0, 210.0, 120.0, noise=0))
    np.testing.assert_array_equal(whole, floating)


def test_a_scene_is_rendered_in_seconds(capsys: pytest.CaptureFixture) -> None:
    start_s = time.process_time()
    render(showcase.markers(), showcase.T_camera_wall, showcase.CAMERA, np.random.default_rng(0))
    spent_s = time.process_time() - start_s
    with capsys.disabled():
        print(f"\n7 markers in 1280x720: {spent_s:.2f} s of CPU")
    assert spent_s < 6
