"""Plans of settings: the paper's, and ours, which leave no depth out."""

import numpy as np
import pytest
from lens_example import MARKER, lens

from tagmetry.errors import InputError
from tagmetry.lens import MarkerKind, depth_of_reading, quick_scan, seed_scan
from tagmetry.lens.scan import search_around


def test_the_paper_s_scan_has_eleven_settings() -> None:
    plan = seed_scan(lens())
    assert [one.focus for one in plan] == [150, 135, 120, 105, 90, 75, 60, 45, 30, 15, 0]
    assert {one.zoom_percent for one in plan} == {500}


@pytest.mark.parametrize("marker", [MARKER, MarkerKind(0.005, 8), MarkerKind(0.03, 8)])
def test_every_depth_is_read_at_some_setting(marker: MarkerKind) -> None:
    camera = lens()
    plan = quick_scan(camera, marker)
    for depth_m in np.linspace(camera.nearest_m, camera.farthest_m, 200):
        sides_px = [
            camera.focal_px(one.magnification) * marker.size_m / depth_m
            for one in plan
            if depth_of_reading(camera, marker, one.focus).holds(depth_m)
        ]
        assert any(19 < side < 1000 for side in sides_px), depth_m


def test_a_10_mm_marker_takes_three_settings_and_the_way_back() -> None:
    plan = quick_scan(lens(), MARKER)
    assert len({one.focus for one in plan}) == 3
    assert len(plan) <= 6


def test_the_scan_begins_where_the_motor_is() -> None:
    near, far = (quick_scan(lens(), MARKER, start)[0].focus for start in (150.0, 0.0))
    assert near > 90
    assert far < 30


def test_a_marker_is_looked_for_where_it_should_be_first() -> None:
    plan = search_around(lens(), MARKER, 0.2, 0.02)
    assert plan[0].focus == pytest.approx(71.8, abs=1)
    assert {one.focus for one in quick_scan(lens(), MARKER)} <= {one.focus for one in plan}


def test_readable_depths_do_not_depend_on_zoom_but_on_aperture() -> None:
    narrow, wide = (depth_of_reading(lens(aperture_m=a), MARKER, 72.0) for a in (0.0016, 0.0032))
    assert narrow.far_m - narrow.near_m == pytest.approx(2 * (wide.far_m - wide.near_m))


def test_plans_that_make_no_sense_are_refused() -> None:
    with pytest.raises(InputError, match="hundreds of images"):
        quick_scan(lens(aperture_m=0.5), MarkerKind(0.001, 8))
    with pytest.raises(InputError, match="step of a scan"):
        seed_scan(lens(), 0.0)
    with pytest.raises(InputError, match="depth and a doubt"):
        search_around(lens(), MARKER, np.nan, 0.1)
    with pytest.raises(InputError, match="size must be positive"):
        MarkerKind(-0.01, 8)
