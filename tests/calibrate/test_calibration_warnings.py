"""Warnings where they matter, and only there."""

import numpy as np
import pytest
from coverage_study import CAMERAS
from seen_boards import USUAL, seen

from tagmetry.calibrate import calibrate
from tagmetry.calibrate.checks import corner_sd_px
from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import Array

PINHOLE = Camera(1001, 801, (1000.0, 1000.0), (500.0, 400.0))


def with_sd(camera: Camera, sd: Array) -> Camera:
    return Camera(*camera.size_px, camera.focal_px, camera.center_px, camera.lens, np.diag(sd**2))


@pytest.mark.parametrize("name", ["55 brown5", "90 brown4", "100 none", "80 fisheye"])
def test_35_good_views_give_no_warning(name: str) -> None:
    camera, lens = CAMERAS[name]
    assert calibrate(seen(camera, 35, np.random.default_rng(1)), lens).warnings == ()


def test_few_views_leave_the_pictures_corners_open() -> None:
    found = calibrate(seen(USUAL, 5, np.random.default_rng(2)), "brown5")
    told = [text for text in found.warnings if "the picture's corners are known to" in text]
    assert f"known to {corner_sd_px(found.camera):.1f} px only" in told[0]


def test_an_unknown_focal_length_is_felt_in_proportion_to_the_distance() -> None:
    sd_px = corner_sd_px(with_sd(PINHOLE, np.array([2.0, 2.0, 0.0, 0.0])))
    assert sd_px == pytest.approx(2 * 0.5)  # x / z = 0.5 at the right, 0.4 at the bottom


def test_an_unknown_centre_is_mostly_a_turn_of_the_camera() -> None:
    """Turned until the centre stays, u moves by -x^2 and v by -x y of what the centre did."""
    sd_px = corner_sd_px(with_sd(PINHOLE, np.array([0.0, 0.0, 1.0, 0.0])))
    assert sd_px == pytest.approx(np.hypot(0.5**2, 0.5 * 0.4))
    sd_px = corner_sd_px(with_sd(PINHOLE, np.array([0.0, 0.0, 0.0, 1.0])))
    assert sd_px == pytest.approx(np.hypot(0.4**2, 0.5 * 0.4))


def test_corners_that_no_ray_reaches_do_not_count() -> None:
    lens = BrownLens((-0.9, 0.0, 0.0, 0.0))
    camera = Camera(1001, 801, (700.0, 700.0), (500.0, 400.0), lens)
    assert corner_sd_px(with_sd(camera, np.ones(8))) == 0.0
