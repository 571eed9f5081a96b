"""The simulated camera's zoom, focus and breathing against closed forms of optics.

The truth of where edges are and how wide they are is written here again: sizes by similar
triangles with the thin lens's image distance, widths by second moments.
"""

from dataclasses import replace

import numpy as np
import pytest
from plain_camera import (
    APERTURE_M,
    F_M,
    PIXEL_M,
    PLAIN,
    camera,
    picture,
    step_edges_px,
    white_square,
)

from tagmetry.camera import BrownLens
from tagmetry.errors import InputError
from tagmetry.twin.camera import (
    Breathing,
    DioptreFocus,
    FixedFocus,
    LogFocus,
)
from tagmetry.twin.optics.thin_lens import ThinLens


@pytest.mark.parametrize("zoom", [100, 101, 137, 200, 333, 500])
def test_zoomed_edges_are_where_similar_triangles_put_them(zoom: int) -> None:
    """In focus, through a pinhole: u = zoom (out / in) (f x / z + cx - middle) + middle out."""
    device = replace(PLAIN, lens=ThinLens(F_M, 0.0, PIXEL_M), breathing=Breathing(0.0))
    scene = white_square(0.5, 0.01, x_m=0.0019)
    twin = camera(scene, device)
    twin.controls.write("zoom", zoom)
    found_px = np.array(step_edges_px(picture(twin)))
    sensor_px = 2000 * (0.0019 + np.array([-0.005, 0.005])) / 0.5 + 311.7
    expected_px = zoom / 100 / 2 * (sensor_px - 319.5) + 159.5
    np.testing.assert_allclose(found_px, expected_px, atol=0.01)
    corners_m = np.array([[0.0019 - 0.005, 0, 0.5], [0.0019 + 0.005, 0, 0.5]])
    np.testing.assert_allclose(twin.true_camera().project(corners_m)[:, 0], expected_px, atol=1e-9)


def test_zoom_of_pixels_that_are_read_two_by_two() -> None:
    """At 150 % a quarter of the sensor's size takes 2 x 2 as one, and shrinks them by 3 / 4."""
    lens = ThinLens(F_M, 0.0, PIXEL_M)
    device = replace(PLAIN, lens=lens, breathing=Breathing(0.0), size_px=(160, 90))
    twin = camera(white_square(0.5, 0.03), device)
    twin.controls.write("zoom", 150)
    sensor_px = 2000 * np.array([-0.015, 0.015]) / 0.5 + 311.7
    expected_px = 1.5 / 4 * (sensor_px - 319.5) + 79.5
    np.testing.assert_allclose(step_edges_px(picture(twin)), expected_px, atol=0.01)


@pytest.mark.parametrize("focus", [0.5, 2.0, 5.0, 12.0, 19.0])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_nearer_focus_magnifies_as_the_lens_moves_out(focus: float, share: float) -> None:
    """The disc is symmetric, so a square out of focus keeps its size by area."""
    device = replace(PLAIN, breathing=Breathing(share))
    twin = camera(white_square(0.5, 0.06), device)
    twin.controls.write("focus", focus)
    left_px, right_px = step_edges_px(picture(twin))
    image_distance_m = 1 / (1 / F_M - focus)
    focal_px = 2000 * (1 + share * (image_distance_m / F_M - 1)) / 2
    assert right_px - left_px == pytest.approx(focal_px * 0.06 / 0.5, rel=2e-4)
    assert twin.true_camera().focal_px == pytest.approx((focal_px, focal_px), rel=1e-12)
    assert twin.true_camera().focus == focus


def test_distortion_breathes_with_the_dioptres() -> None:
    sensor = replace(PLAIN.sensor, lens=BrownLens((0.1, -0.2, 0.0, 0.0)))
    device = replace(PLAIN, sensor=sensor, breathing=Breathing(0.0, (0.01, 0.02, 0.0, 0.0)))
    twin = camera(device=device)
    twin.controls.write("focus", 4.0)
    twin.take()
    assert twin.true_camera().lens.coefficients == pytest.approx((0.14, -0.12, 0.0, 0.0))


def test_breathing_needs_a_number_for_each_coefficient() -> None:
    twin = camera(device=replace(PLAIN, breathing=Breathing(1.0, (0.1,))))
    with pytest.raises(InputError, match="each of the lens's 0 distortion coefficients, got 1"):
        twin.take()


def edge_variance_px2(light: np.ndarray) -> float:
    """The second moment of the left edge's line spread, from the rows of the middle."""
    half = light.shape[0] // 2
    row = light[half - 5 : half + 5, : light.shape[1] // 2].mean(axis=0)
    slope = np.diff(row) / (row[-1] - row[0])
    places = np.arange(len(slope))
    return float(slope @ (places - slope @ places) ** 2)


@pytest.mark.parametrize(
    ("focus", "zoom"), [(6.0, 100), (9.0, 100), (12.0, 100), (5.0, 200), (8.0, 300), (18.0, 200)]
)
def test_an_edge_out_of_focus_is_as_wide_as_the_thin_lens_says(focus: float, zoom: int) -> None:
    """A disc of radius R has the second moment R^2 / 4 along an axis.

    R = A v |1/z - 1/d| / 2 pixel. A pixel that is read adds 1/12 of its side squared; the zoom adds
    1/6 for its linear interpolation and the 1/12 of a pixel given, unless it takes pixels as they
    are; and so does the difference of neighbours another 1/12.
    """
    twin = camera(white_square(0.5, 0.1, x_m=0.03), PLAIN)
    twin.controls.write("zoom", zoom)
    twin.controls.write("focus", focus)
    image_distance_m = 1 / (1 / F_M - focus)
    radius_m = APERTURE_M * image_distance_m * abs(1 / 0.5 - focus) / 2
    radius_px = radius_m / PIXEL_M * zoom / 100 / 2
    read_px = max(zoom / 200, 1)  # two by two as one at 100, as they are at 200
    expected = radius_px**2 / 4 + read_px**2 / 12 + 1 / 12
    expected += (zoom > 200) * (read_px**2 / 6 + 1 / 12)
    assert edge_variance_px2(picture(twin)) == pytest.approx(expected, rel=0.012)


def test_in_focus_an_edge_is_sharp() -> None:
    assert edge_variance_px2(picture(camera(white_square(0.5, 0.1, x_m=0.03)))) < 0.26


def test_the_seeds_focus_law() -> None:
    """F(0.05) = 130, F(0.1) = 101, F(0.5) = 33, F(1.0) = 4."""
    law = LogFocus()
    for distance_m, value in ((0.05, 130.15), (0.1, 100.96), (0.5, 33.19), (1.0, 4.0)):
        assert law.value(distance_m) == pytest.approx(value, abs=0.01)
        assert law.distance_m(law.value(distance_m)) == pytest.approx(distance_m, rel=1e-12)
    assert DioptreFocus(8.0).distance_m(0.0) == np.inf
    assert DioptreFocus(8.0).distance_m(DioptreFocus(8.0).value(0.3)) == pytest.approx(0.3)
    assert FixedFocus(2.0).distance_m(77.0) == 2.0
