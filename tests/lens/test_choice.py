"""The next setting: sharp, within the image, worth the change."""

import numpy as np
import pytest
from lens_example import MARKER, lens

from tagmetry.lens import LensSetting, Whereabouts, best_setting, next_setting
from tagmetry.lens.accuracy import prospect

LENS = lens()


def at(depth_m: float, x_m: float = 0.0, tilt_deg: float = 30.0) -> Whereabouts:
    return Whereabouts(np.array([x_m, 0.0, depth_m]), float(np.radians(tilt_deg)))


@pytest.mark.parametrize("depth_m", [0.05, 0.1, 0.3, 0.6, 1.05])
def test_the_best_setting_is_nearly_sharp_and_shows_the_marker(depth_m: float) -> None:
    setting = best_setting(LENS, MARKER, at(depth_m))
    assert 0.2 < LENS.blur_of_depth_px(setting, depth_m) / 4 < 1.0  # as wide as a pixel
    side_px = LENS.focal_px(setting.magnification) * MARKER.size_m / depth_m
    assert side_px * np.cos(np.radians(30)) + 0.5 >= 20
    assert side_px * np.sqrt(2) < 1080


def test_zoom_stays_where_it_tells_no_more() -> None:
    assert 150 <= best_setting(LENS, MARKER, at(0.3)).zoom_percent <= 210


def test_a_marker_aside_is_kept_within_the_image() -> None:
    setting = best_setting(LENS, MARKER, at(0.2, x_m=0.12))
    assert LENS.focal_px(setting.magnification) * 0.125 / 0.2 < 960
    assert setting.zoom_percent < 140


def test_an_oblique_marker_far_away_takes_more_zoom() -> None:
    zooms = [best_setting(LENS, MARKER, at(1.0, 0, tilt)).zoom_percent for tilt in (0, 60)]
    assert zooms[1] > 1.5 * zooms[0]


def test_a_setting_that_is_nearly_as_good_is_kept() -> None:
    now = best_setting(LENS, MARKER, at(0.30))
    assert next_setting(LENS, MARKER, at(0.305), now) == now
    assert next_setting(LENS, MARKER, at(0.40), now) != now


def test_choosing_comes_to_rest() -> None:
    for depth_m in np.geomspace(0.05, 1.05, 40):
        first = next_setting(LENS, MARKER, at(depth_m), LensSetting(500, 150))
        assert next_setting(LENS, MARKER, at(depth_m), first) == first


def test_blur_and_distance_promise_less() -> None:
    sharp = prospect(LENS, MARKER, 0.5, LENS.sharp_at(0.5, 200)).depth_share
    assert prospect(LENS, MARKER, 1.0, LENS.sharp_at(1.0, 200)).depth_share > 1.8 * sharp
    assert prospect(LENS, MARKER, 0.5, LensSetting(200, 110)).depth_share > 10 * sharp
