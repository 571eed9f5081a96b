"""Calibration and distances are judged by numbers alone."""

import re

import pytest

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.detect.doctor import MeasuredMarker, check_calibration, check_distances

GOOD = Camera(640, 480, (600.0, 600.0), (319.5, 239.5))


def one(advice):
    assert len(advice) == 1
    return advice[0]


def test_a_calibration_that_fits() -> None:
    advice = one(check_calibration(GOOD, 640, 480))
    assert (advice.severity, advice.explanation) == ("ok", "640x480, 56° wide")


@pytest.mark.parametrize(
    ("size_px", "remedy"),
    [
        ((1280, 960), "a factor of 2, .*--scale-to 1280x960"),
        ((1280, 720), "factors differ .2 across, 1.5 down"),
        ((480, 640), "sides are swapped"),
    ],
)
def test_another_resolution(size_px, remedy) -> None:
    advice = one(check_calibration(GOOD, *size_px))
    assert (advice.severity, advice.title) == ("problem", "a calibration of another resolution")
    assert re.search(remedy, advice.remedy)


@pytest.mark.parametrize(("focal_px", "view"), [(4.0, "1.8e+02°"), (40000.0, "0.92°")])
def test_a_focal_length_in_millimetres_or_of_no_camera(focal_px, view) -> None:
    camera = Camera(640, 480, (focal_px, focal_px), (319.5, 239.5))
    advice = one(check_calibration(camera, 640, 480))
    assert advice.title == "an implausible focal length"
    assert view in advice.explanation


def test_a_fisheye_may_be_wide() -> None:
    camera = Camera(640, 480, (180.0, 180.0), (319.5, 239.5), FisheyeLens((0.0, 0.0, 0.0, 0.0)))
    assert "an implausible focal length" not in [
        a.title for a in check_calibration(camera, 640, 480)
    ]


def test_a_principal_point_outside() -> None:
    camera = Camera(640, 480, (600.0, 600.0), (700.0, 239.5))
    assert one(check_calibration(camera, 640, 480)).title.startswith(
        "the principal point is outside"
    )


def test_distortion_that_folds() -> None:
    camera = Camera(640, 480, (400.0, 400.0), (319.5, 239.5), BrownLens((-0.8, 0.0, 0.0, 0.0)))
    advice = one(check_calibration(camera, 640, 480))
    assert advice.title == "the distortion folds inside the image"
    assert "of the pixels have no ray" in advice.explanation


@pytest.mark.parametrize(
    ("size_m", "distance_m", "meant"),
    [
        (120.0, 600.0, "0.12 m was meant, giving 0.6 m"),
        (0.00012, 0.001, "0.12 m was meant, giving 1 m"),
    ],
)
def test_a_size_in_the_wrong_unit(size_m, distance_m, meant) -> None:
    advice = one(check_distances([MeasuredMarker("tag36h11 id 7", size_m, distance_m, 0.0)]))
    assert (advice.severity, advice.title) == ("problem", "an implausible distance")
    assert meant in advice.remedy


def test_an_ambiguous_pose() -> None:
    sure = MeasuredMarker("tag36h11 id 1", 0.1, 1.0, 0.01)
    unsure = MeasuredMarker("tag36h11 id 2", 0.1, 1.0, 0.4)
    advice = one(check_distances([sure, unsure]))
    assert (advice.severity, advice.title) == ("hint", "a pose that may be flipped")
    assert "worst is tag36h11 id 2: the other tilt has a probability of 40%" in advice.explanation


def test_plausible_distances_get_no_advice() -> None:
    assert check_distances([MeasuredMarker("tag36h11 id 1", 0.1, 1.0, 0.0)]) == ()
