"""One image in, one result out: whose camera and size count, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import Image, scaled
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.pipeline import Measurement
from tagmetry.pose import estimate_pose
from tagmetry.twin import render, showcase

CAMERA = showcase.CAMERA
DETECTOR = Detector([showcase.FAMILY])
IDS = (0, 1, 2, 3, 10, 13, 14)


@pytest.fixture(scope="module")
def image() -> Image:
    rng = np.random.default_rng(1)
    pixels = render(showcase.markers(), showcase.T_camera_wall, CAMERA, rng)
    return Image(pixels, time_s=2.5, time_kind="capture", sequence=9, source="scene")


def test_a_result_tells_which_image_it_was(image: Image) -> None:
    result = Measurement(DETECTOR).measure(image)
    assert (result.source, result.sequence, result.time_s) == ("scene", 9, 2.5)
    assert (result.time_kind, result.width_px, result.height_px) == ("capture", 1280, 720)
    assert tuple(marker.detection.id for marker in result.markers) == IDS


@pytest.mark.parametrize(
    ("camera", "sizes_m"), [(None, None), (CAMERA, None), (None, 0.12), (None, {0: 0.12})]
)
def test_without_size_or_camera_there_are_no_poses(
    camera: object, sizes_m: object, image: Image
) -> None:
    result = Measurement(DETECTOR, camera, sizes_m).measure(image)
    assert [marker.pose for marker in result.markers] == [None] * len(IDS)


def test_poses_are_those_of_estimate_pose(image: Image) -> None:
    for marker in Measurement(DETECTOR, CAMERA, 0.12).measure(image).markers:
        alone = estimate_pose(marker.detection, CAMERA, 0.12)
        assert len(marker.pose.hypotheses) == len(alone.hypotheses)
        np.testing.assert_allclose(
            marker.pose.best.T_camera_marker.as_matrix(),
            alone.best.T_camera_marker.as_matrix(),
            atol=1e-9,
        )


def test_sizes_go_by_id(image: Image) -> None:
    one = Measurement(DETECTOR, CAMERA, 0.12).measure(image).markers
    some = Measurement(DETECTOR, CAMERA, {1: 0.12, 3: 0.24, 99: 1.0}).measure(image).markers
    assert [marker.detection.id for marker in some if marker.pose is not None] == [1, 3]
    position_m = [m.pose.best.T_camera_marker.translation for m in (one[1], some[1])]
    np.testing.assert_allclose(position_m[1], position_m[0], atol=1e-9)
    position_m = [m.pose.best.T_camera_marker.translation for m in (one[3], some[3])]
    np.testing.assert_allclose(position_m[1], 2 * position_m[0], atol=1e-7)
    assert some[3].pose.size_m == 0.24


def test_the_images_own_camera_is_used(image: Image) -> None:
    own = replace(image, camera=CAMERA)
    found = Measurement(DETECTOR, sizes_m=0.12).measure(own)
    given = Measurement(DETECTOR, CAMERA, 0.12).measure(image)
    for a, b in zip(found.markers, given.markers, strict=True):
        np.testing.assert_array_equal(
            a.pose.best.T_camera_marker.as_matrix(), b.pose.best.T_camera_marker.as_matrix()
        )


def test_a_given_camera_wins_over_the_images(image: Image) -> None:
    other = replace(CAMERA, focal_px=(2200.0, 2200.0))
    own = replace(image, camera=other)
    depths_m = [
        task.measure(own).markers[0].pose.best.T_camera_marker.translation[2]
        for task in (Measurement(DETECTOR, CAMERA, 0.12), Measurement(DETECTOR, None, 0.12))
    ]
    assert depths_m[0] == pytest.approx(1.005, abs=1e-3)
    assert depths_m[1] > 1.8 * depths_m[0]


@pytest.mark.parametrize("step", ["measure", "explain"])
@pytest.mark.parametrize("where", ["task", "image"])
def test_a_camera_of_another_size_is_refused(step: str, where: str, image: Image) -> None:
    small = scaled(CAMERA, 640, 360)
    task = Measurement(DETECTOR, small if where == "task" else None, 0.12)
    shown = replace(image, camera=small) if where == "image" else image
    with pytest.raises(InputError, match=r"^scene: .* belong to 640x360 images, this one"):
        getattr(task, step)(shown)


def test_detections_of_another_image_are_refused_too(image: Image) -> None:
    with pytest.raises(InputError, match="belong to 640x360 images"):
        Measurement(DETECTOR, scaled(CAMERA, 640, 360), 0.12).result(image, ())


def test_explains_the_same_markers(image: Image) -> None:
    task = Measurement(DETECTOR, CAMERA, 0.12)
    findings = task.explain(image)
    result = task.result(image, findings.detections)
    for a, b in zip(result.markers, task.measure(image).markers, strict=True):
        assert (a.detection.family, a.detection.id) == (b.detection.family, b.detection.id)
        # Explaining looks at more squares, so the fit begins elsewhere.
        np.testing.assert_allclose(a.detection.corners_px, b.detection.corners_px, atol=1e-3)


@pytest.mark.parametrize("sizes_m", [0.0, -0.1, float("nan"), float("inf"), {3: 0.1, 4: 0.0}])
def test_a_size_that_is_none_is_refused_at_once(sizes_m: object) -> None:
    with pytest.raises(InputError, match="size must be a positive number of metres"):
        Measurement(DETECTOR, CAMERA, sizes_m)


def test_an_image_that_cannot_be_read_is_named() -> None:
    dot = Image(np.zeros((1, 1), np.uint8), source="dot.png")
    with pytest.raises(InputError, match=r"^dot\.png: an image of 1x1 pixels is too small"):
        Measurement(DETECTOR).measure(dot)
    with pytest.raises(InputError, match=r"^image: an image of 1x1"):
        Measurement(DETECTOR).measure(replace(dot, source=""))
