"""Following markers from image to image gives the same results as looking at each image whole."""

import numpy as np
import pytest

from tagmetry.camera import Camera, Image
from tagmetry.detect import Detector, Tracker
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.pipeline import Measurement
from tagmetry.twin import render

CAMERA = Camera(320, 240, (400.0, 400.0), (159.5, 119.5))
DETECTOR = Detector()


def film(count: int, source: str = "film") -> list[Image]:
    images = []
    for k in range(count):
        turned = Rotation.from_euler("x", 160, degrees=True)
        at = RigidTransform.from_components([0.01 * k - 0.04, 0.0, 0.6], turned)
        pixels = render([MountedMarker("tag36h11", 5, 0.1, at)], RigidTransform.identity(),
                        CAMERA, np.random.default_rng(k))  # fmt: skip
        images.append(Image(pixels, k / 30, "capture", k, source, CAMERA))
    return images


def test_poses_are_those_of_whole_images() -> None:
    tracking = Measurement(DETECTOR, sizes_m=0.1, tracker=Tracker(DETECTOR))
    whole = Measurement(DETECTOR, sizes_m=0.1)
    for image in film(5):
        (one,), (other,) = tracking.measure(image).markers, whole.measure(image).markers
        assert one.pose is not None
        assert other.pose is not None
        apart = one.pose.best.T_camera_marker.inv() * other.pose.best.T_camera_marker
        assert np.linalg.norm(apart.translation) < 1e-4


def test_another_source_may_begin_at_an_earlier_time() -> None:
    task = Measurement(DETECTOR, tracker=Tracker(DETECTOR))
    for source in ("first.mp4", "second.mp4"):
        task.begin_source()
        assert [len(task.measure(image).markers) for image in film(2, source)] == [1, 1]


def test_pictures_without_times_are_refused() -> None:
    task = Measurement(DETECTOR, tracker=Tracker(DETECTOR))
    with pytest.raises(InputError, match=r"photo\.png: expected images with times"):
        task.measure(Image(film(1)[0].pixels, source="photo.png"))


def test_a_time_that_stands_still_is_refused_by_name() -> None:
    task = Measurement(DETECTOR, tracker=Tracker(DETECTOR))
    (image,) = film(1)
    task.measure(image)
    with pytest.raises(InputError, match=r"film: time_s must rise from image to image"):
        task.measure(image)
