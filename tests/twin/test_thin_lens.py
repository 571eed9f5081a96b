"""The thin lens: against rays traced through it, and against an optician's numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.twin.optics.thin_lens import ThinLens

LENS = ThinLens(focal_m=0.016, aperture_m=0.008, pixel_m=3e-6)


def rim_ray_px(lens: ThinLens, depth_m: float, sensor_m: float) -> float:
    """Trace the ray of a point on the axis through the lens's rim to the sensor, pixels."""
    height_m = lens.aperture_m / 2
    slope = height_m / depth_m - height_m / lens.focal_m  # the lens bends it by height / f
    return (height_m + sensor_m * slope) / lens.pixel_m


@given(st.floats(0.03, 50.0), st.floats(0.03, 50.0))
def test_a_disc_is_as_wide_as_the_ray_through_the_rim(depth_m: float, focus_m: float) -> None:
    sensor_m = LENS.image_distance_m(focus_m)
    expected_px = abs(rim_ray_px(LENS, depth_m, sensor_m))
    assert LENS.blur_radius_px(depth_m, focus_m) == pytest.approx(expected_px, rel=1e-7, abs=1e-6)


@given(st.floats(0.03, 1e4))
def test_rays_of_a_point_in_focus_meet_on_the_sensor(focus_m: float) -> None:
    assert rim_ray_px(LENS, focus_m, LENS.image_distance_m(focus_m)) == pytest.approx(0, abs=1e-8)
    assert LENS.blur_radius_px(focus_m, focus_m) == 0


def test_a_portrait_lens_has_the_background_discs_of_the_textbook() -> None:
    """50 mm f/2 at 2 m: f^2 / (N (d - f)) = 0.641 mm across for a point far away."""
    lens = ThinLens.from_f_number(0.05, 2.0, 5e-6)
    assert lens.aperture_m == 0.025
    assert lens.f_number == 2.0
    assert 2 * lens.blur_radius_px(np.inf, 2.0) * 5e-6 == pytest.approx(0.641e-3, abs=1e-6)


def test_focused_at_infinity_a_disc_is_the_aperture_seen_from_the_point() -> None:
    """A distant point is sharp; at depth z the disc is A f / z."""
    assert LENS.image_distance_m(np.inf) == 0.016
    assert LENS.blur_radius_px(np.inf, np.inf) == 0
    expected_px = 0.008 * 0.016 / 2.0 / 2 / 3e-6
    assert LENS.blur_radius_px(2.0, np.inf) == pytest.approx(expected_px, rel=1e-12)


def test_nearer_focus_magnifies() -> None:
    """f' = f d / (d - f): at twice the focal length the picture is life-size, v = 2 f."""
    assert LENS.focal_px(np.inf) == pytest.approx(0.016 / 3e-6)
    assert LENS.focal_px(0.032) == pytest.approx(2 * 0.016 / 3e-6)
    near_px, far_px = LENS.focal_px(0.2), LENS.focal_px(0.4)
    assert near_px / far_px == pytest.approx((0.2 / 0.184) / (0.4 / 0.384), rel=1e-12)


def test_a_pinhole_is_sharp_everywhere() -> None:
    pinhole = ThinLens(0.016, 0.0, 3e-6)
    assert pinhole.f_number == np.inf
    np.testing.assert_array_equal(pinhole.blur_radius_px(np.array([0.01, 1, np.inf]), 1.0), 0.0)


def test_depths_keep_their_shape_and_have_no_disc_behind_the_lens() -> None:
    radii_px = LENS.blur_radius_px(np.array([[1.0, 2.0], [0.0, -1.0]]), 1.0)
    assert radii_px.shape == (2, 2)
    assert radii_px[0, 0] == 0
    assert radii_px[0, 1] > 0
    assert np.isnan(radii_px[1]).all()


@pytest.mark.parametrize("focus_m", [0.016, 0.01, -1.0, 0.0, float("nan")])
def test_refuses_a_focus_that_no_sensor_can_reach(focus_m: float) -> None:
    with pytest.raises(InputError, match=r"a lens of 0\.016 m cannot focus at"):
        LENS.focal_px(focus_m)


@pytest.mark.parametrize(
    ("numbers", "text"),
    [
        ((0.0, 0.01, 1e-6), "focal_m must be positive"),
        ((float("inf"), 0.01, 1e-6), "focal_m must be positive"),
        ((0.01, -0.01, 1e-6), "aperture_m must be 0 or more"),
        ((0.01, 0.01, float("nan")), "pixel_m must be positive"),
    ],
)
def test_refuses_lenses_that_are_none(numbers: tuple[float, float, float], text: str) -> None:
    with pytest.raises(InputError, match=text):
        ThinLens(*numbers)
    with pytest.raises(InputError, match="f_number must be positive"):
        ThinLens.from_f_number(0.01, 0.0, 1e-6)
