"""Resampling moves every point to where the rule of pixel centres says, to a millionth."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import make_interp_spline
from scipy.special import ndtr

from tagmetry.camera import Camera, scaled, zoomed
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array, FloatImage
from tagmetry.twin.optics.digital_zoom import Interpolation, zoomed_pixels

SIZES = st.integers(3, 60)
ZOOMS = st.floats(1.0, 8.0)


def ramp(width_px: int, height_px: int) -> FloatImage:
    """Return u / width + v / height."""
    u, v = np.arange(width_px) / width_px, np.arange(height_px) / height_px
    return (u + v[:, None]).astype(np.float32)


def source_places(size_in: int, size_out: int, zoom: float) -> Array:
    """Return where the pixels of one axis come from."""
    at = (np.arange(size_out) - (size_out - 1) / 2) * size_in / (zoom * size_out)
    return at + (size_in - 1) / 2


def inner(size_in: int, size_out: int, zoom: float) -> np.ndarray:
    """Return which pixels of one axis lie so far inside that no border is seen."""
    at = source_places(size_in, size_out, zoom)
    reach = 2 + size_in / (2 * zoom * size_out)
    return (at >= reach) & (at <= size_in - 1 - reach)


@pytest.mark.parametrize("interpolation", ["linear", "cubic"])
@given(SIZES, SIZES, SIZES, SIZES, ZOOMS)
def test_a_ramp_stays_the_ramp_at_any_zoom(
    interpolation: Interpolation, width: int, height: int, out_w: int, out_h: int, zoom: float
) -> None:
    seen = zoomed_pixels(ramp(width, height), zoom, out_w, out_h, interpolation)
    u, v = source_places(width, out_w, zoom), source_places(height, out_h, zoom)
    expected = u / width + v[:, None] / height
    kept = np.ix_(inner(height, out_h, zoom), inner(width, out_w, zoom))
    assert seen.dtype == np.float32
    np.testing.assert_allclose(seen[kept], expected[kept], atol=1e-6)


def means_of(places: Array, values: Array, at: Array, width: float, degree: int) -> Array:
    """Return an interpolating spline's means over a width around places, by counting."""
    spline = make_interp_spline(places, values, k=degree)
    within = (np.arange(2000) + 0.5) / 2000 - 0.5
    return spline(at[:, None] + width * within).mean(axis=1)


@pytest.mark.parametrize(("out", "zoom"), [(40, 1.0), (40, 1.37), (23, 1.0), (90, 2.2), (17, 1.9)])
def test_linear_is_the_mean_of_straight_lines_between_pixels(out: int, zoom: float) -> None:
    line = np.random.default_rng(0).random((1, 41), dtype=np.float32)
    seen = zoomed_pixels(line, zoom, out, 1)[0]
    kept, at = inner(41, out, zoom), source_places(41, out, zoom)
    expected = means_of(np.arange(41), line[0], at[kept], 41 / (zoom * out), 1)
    np.testing.assert_allclose(seen[kept], expected, atol=2e-5)


@pytest.mark.parametrize("zoom", [1.0, 1.6, 2.0, 3.3])
def test_cubic_keeps_parabolas_but_for_the_mean_over_a_pixel(zoom: float) -> None:
    """The mean of x^2 over a width w is x^2 + w^2 / 12."""
    line = (np.arange(40) / 40) ** 2
    seen = zoomed_pixels(np.tile(line, (6, 1)).astype(np.float32), zoom, 39, 6, "cubic")
    kept, at = inner(40, 39, zoom), source_places(40, 39, zoom)
    expected = (at**2 + (40 / 39 / zoom) ** 2 / 12) / 40**2
    np.testing.assert_allclose(seen[3][kept], expected[kept], atol=1e-6)


@pytest.mark.parametrize(("width_px", "height_px"), [(30, 20), (25, 14), (7, 3), (60, 40)])
def test_area_is_the_mean_of_what_a_pixel_covers(width_px: int, height_px: int) -> None:
    image = np.random.default_rng(0).random((40, 60), dtype=np.float32)
    seen = zoomed_pixels(image, 1.0, width_px, height_px, "area")
    expected = cv2.resize(image, (width_px, height_px), interpolation=cv2.INTER_AREA)
    np.testing.assert_allclose(seen, expected, atol=2e-6)


def test_a_whole_zoom_by_area_is_the_cut_out_middle() -> None:
    image = np.random.default_rng(1).random((40, 60), dtype=np.float32)
    seen = zoomed_pixels(image, 2.0, 30, 20, "area")
    np.testing.assert_allclose(seen, image[10:30, 15:45], atol=1e-6)


@pytest.mark.parametrize("interpolation", ["area", "linear", "cubic"])
def test_stripes_too_fine_for_the_output_become_grey(interpolation: Interpolation) -> None:
    stripes = np.tile(np.array([0.0, 1.0], np.float32), (60, 120))
    seen = zoomed_pixels(stripes, 1.0, 60, 15, interpolation)
    np.testing.assert_allclose(seen[:, 2:-2], 0.5, atol=1e-6)


@pytest.mark.parametrize("interpolation", ["area", "linear", "cubic"])
@given(SIZES, SIZES, ZOOMS)
def test_an_even_image_stays_even_to_its_border(
    interpolation: Interpolation, size: int, out: int, zoom: float
) -> None:
    even = np.full((size, 5), 0.7, np.float32)
    np.testing.assert_allclose(zoomed_pixels(even, zoom, 4, out, interpolation), 0.7, atol=1e-6)


def edge_place_px(row: FloatImage) -> float:
    """Return where a soft edge from 0 to 1 stands, by the light right of it."""
    return len(row) - 0.5 - float(row.sum(dtype=np.float64))


@pytest.mark.parametrize("interpolation", ["area", "linear", "cubic"])
@pytest.mark.parametrize(
    ("zoom", "width_px", "height_px"),
    [(1.0, 640, 360), (1.0, 500, 281), (2.3, 640, 360), (4.0, 900, 600), (1.15, 1280, 720)],
)
def test_an_edge_lands_where_the_zoomed_camera_projects_it(
    interpolation: Interpolation, zoom: float, width_px: int, height_px: int
) -> None:
    sensor = Camera(1280, 720, (1000.0, 1010.0), (650.3, 340.8))
    camera = scaled(zoomed(sensor, zoom), width_px, height_px)
    point = np.array([0.004, 0.017, 1.0])
    u, v = sensor.project(point)
    upright = np.tile(ndtr((np.arange(1280) - u) / 0.7), (720, 1)).astype(np.float32)
    level = np.tile(ndtr((np.arange(720) - v) / 0.7)[:, None], (1, 1280)).astype(np.float32)
    columns = zoomed_pixels(upright, zoom, width_px, height_px, interpolation)
    rows = zoomed_pixels(level, zoom, width_px, height_px, interpolation)
    expected_u, expected_v = camera.project(point)
    assert edge_place_px(columns[height_px // 2]) == pytest.approx(expected_u, abs=1e-4)
    assert edge_place_px(rows[:, width_px // 2]) == pytest.approx(expected_v, abs=1e-4)


def test_no_zoom_at_the_same_size_changes_nothing() -> None:
    image = np.random.default_rng(2).random((20, 30), dtype=np.float32)
    assert zoomed_pixels(image, 1.0, 30, 20) is image


def test_whole_grey_values_become_floating_ones() -> None:
    image = np.random.default_rng(3).integers(0, 255, (20, 30), dtype=np.uint8)
    seen = zoomed_pixels(image, 1.0, 15, 10, "area")
    expected = image.reshape(10, 2, 15, 2).mean(axis=(1, 3))
    np.testing.assert_allclose(seen, expected, rtol=1e-6)


def test_one_pixel_can_fill_an_image() -> None:
    one = np.full((1, 1), 0.3, np.float32)
    np.testing.assert_allclose(zoomed_pixels(one, 5.0, 4, 3, "cubic"), 0.3, rtol=1e-6)


@pytest.mark.parametrize("zoom", [0.5, 0.0, -1.0, float("nan"), float("inf")])
def test_refuses_a_zoom_that_is_none(zoom: float) -> None:
    with pytest.raises(InputError, match="a digital zoom is at least 1, got"):
        zoomed_pixels(np.zeros((4, 4), np.float32), zoom, 4, 4)


def test_refuses_images_and_sizes_that_are_none() -> None:
    with pytest.raises(InputError, match=r"expected an image of shape \(height, width\)"):
        zoomed_pixels(np.zeros((4, 0), np.float32), 1.0, 4, 4)
    with pytest.raises(InputError, match="image size must be positive, got 0x4"):
        zoomed_pixels(np.zeros((4, 4), np.float32), 1.0, 0, 4)
    with pytest.raises(InputError, match="expected interpolation area or linear or cubic, got"):
        zoomed_pixels(np.zeros((4, 4), np.float32), 1.0, 4, 3, "lanczos")
