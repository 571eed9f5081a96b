"""Levels and blur of a marker drawn here, and what exposure follows from them."""

import cv2
import numpy as np
import pytest

from tagmetry.camera.controls import Control
from tagmetry.detect import Detection
from tagmetry.lens import Levels, better_exposure_s, bracket, marker_blur_px, marker_levels

EXPOSURE = Control("exposure", 1e-4, 333e-4, 1e-4, 100e-4, "s")
CORNERS_PX = np.array([[60.0, 50], [220, 50], [220, 210], [60, 210]])
SEEN = Detection("tag36h11", 7, CORNERS_PX, 1e-4 * np.eye(8), 0, 1.0)


def picture(black: int, white: int, blur_px: float) -> np.ndarray:
    image = np.full((260, 280), white, np.uint8)
    image[50:210, 60:220] = black
    image[80:180, 90:190] = white
    return cv2.GaussianBlur(image, (0, 0), blur_px)


def test_levels_are_those_of_border_and_paper() -> None:
    levels = marker_levels(picture(40, 170, 1.0), SEEN, 8)
    assert (levels.black, levels.white) == pytest.approx((40, 170), abs=2)
    assert levels.contrast == pytest.approx(130, abs=4)


@pytest.mark.parametrize("blur_px", [0.8, 2.0, 4.0])
def test_blur_is_the_gaussian_s(blur_px: float) -> None:
    # the pixel's own square and the interpolation are in what is seen
    assert marker_blur_px(picture(20, 200, blur_px), SEEN, 8) == pytest.approx(blur_px, rel=0.12)


def test_no_contrast_no_blur() -> None:
    assert np.isnan(marker_blur_px(np.full((260, 280), 90, np.uint8), SEEN, 8))


def test_the_marker_s_white_is_brought_to_its_place() -> None:
    light = 0.7**2.2 / 0.01  # per second
    exposure_s = 0.002
    for _ in range(4):
        white = 255 * min((light * exposure_s) ** (1 / 2.2), 1.0)
        exposure_s = better_exposure_s(Levels(10, white), exposure_s, EXPOSURE)
    assert exposure_s == pytest.approx(0.01, rel=0.35)
    assert better_exposure_s(Levels(10, 178), 0.01, EXPOSURE) == 0.01


def test_too_bright_goes_down_and_the_control_s_limits_hold() -> None:
    assert better_exposure_s(Levels(30, 255), 0.01, EXPOSURE) == pytest.approx(0.004)
    assert better_exposure_s(Levels(0, 3), 0.03, EXPOSURE) == EXPOSURE.most


def test_a_bracket_reaches_far_to_both_sides_within_limits() -> None:
    tried = bracket(0.004, EXPOSURE)
    assert tried[0] == 0.004
    assert min(tried) == pytest.approx(0.0003)
    assert max(tried) == EXPOSURE.most
