"""What others write is understood, and others understand what is written."""

import dataclasses
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml
from camera_examples import FULL, KALIBR, OPENCV, ROS, load_text

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.files import load_camera, save_camera


@pytest.mark.parametrize("name", ["cam.yaml", "cam.json"])
@pytest.mark.parametrize("lens", [FULL.lens, FisheyeLens(), BrownLens(tuple(range(14)))])
def test_opencv_reads_our_file(tmp_path: Path, name: str, lens: Lens) -> None:
    camera = Camera(640, 480, (500.25, 1e-3), (320.1, 1e5), lens, name="é: x", provenance="a\nb")
    covariance = np.eye(camera.parameter_count) / 3
    camera = dataclasses.replace(camera, covariance=covariance)
    save_camera(camera, tmp_path / name, "opencv")
    storage = cv2.FileStorage(str(tmp_path / name), cv2.FILE_STORAGE_READ)
    np.testing.assert_array_equal(storage.getNode("camera_matrix").mat(), camera.matrix)
    found = storage.getNode("distortion_coefficients").mat()
    np.testing.assert_array_equal(found.ravel(), lens.coefficients)
    assert storage.getNode("image_width").real() == 640
    section = storage.getNode("tagmetry")
    assert section.getNode("name").string() == "é: x"
    assert section.getNode("covariance").at(2).at(2).real() == 1 / 3


@pytest.mark.parametrize("name", ["cam.yml", "cam.json"])
@pytest.mark.parametrize("shape", [(1, 5), (5, 1)])
@pytest.mark.parametrize(
    "keys", [("camera_matrix", "distortion_coefficients"), ("K", "dist_coeffs")]
)
def test_reads_what_opencv_writes(
    tmp_path: Path, name: str, shape: tuple[int, int], keys: tuple[str, str]
) -> None:
    rng = np.random.default_rng(3)
    K = np.array([[rng.uniform(500, 900), 0, 640.5], [0, 1e3 / 3, 1e-9], [0, 0, 1]])
    distortion = rng.normal(size=shape) * 10.0 ** rng.integers(-9, 3, size=shape)
    storage = cv2.FileStorage(str(tmp_path / name), cv2.FILE_STORAGE_WRITE)
    storage.write("calibration_time", "Thu 01 Jan 2026 10:00:00")
    storage.write("image_width", 1280)
    storage.write("image_height", 720)
    storage.write(keys[0], K)
    storage.write(keys[1], distortion)
    storage.write("per_view_reprojection_errors", rng.normal(size=(30, 1)).astype(np.float32))
    storage.release()
    camera = load_camera(tmp_path / name)
    assert camera.size_px == (1280, 720)
    np.testing.assert_array_equal(camera.matrix, K)
    assert camera.lens == BrownLens(tuple(distortion.ravel()))


def test_ros_camera(tmp_path: Path) -> None:
    camera = load_text(tmp_path, ROS)
    assert camera.size_px == (640, 480)
    assert (camera.focal_px, camera.center_px) == ((739.08, 740.12), (321.5, 100.0))
    assert camera.lens == BrownLens((-0.36, 0.13, 4.6e-05, -1e-3, 0.0))
    assert camera.name == "00314159"


def test_serial_number_as_name(tmp_path: Path) -> None:
    assert load_text(tmp_path, ROS.replace("00314159", "314159")).name == "314159"


def test_kalibr_gives_the_first_camera_or_the_named_one(tmp_path: Path) -> None:
    first, second = load_text(tmp_path, KALIBR), load_text(tmp_path, KALIBR, "cam1")
    assert (first.name, first.size_px) == ("cam0", (752, 480))
    assert (first.focal_px, first.center_px) == ((458.654, 457.296), (367.215, 248.375))
    assert first.lens == BrownLens((-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05))
    assert (second.name, second.size_px) == ("cam1", (752, 481))
    assert second.lens == FisheyeLens((0.01, -0.02, 0.003, -0.0004))


def test_opencv_fisheye_flag(tmp_path: Path) -> None:
    assert load_text(tmp_path, OPENCV).lens == BrownLens((0.1, 0.0, 0.0, 0.0))
    fisheye = OPENCV.replace("fisheye_model: 0", "fisheye_model: 1")
    assert load_text(tmp_path, fisheye).lens == FisheyeLens((0.1, 0.0, 0.0, 0.0))


def test_lists_of_lists_are_understood(tmp_path: Path) -> None:
    text = """{"image_width": 4, "image_height": 3,
    "cameraMatrix": [[5, 0, 1], [0, 6, 2], [0, 0, 1]],
    "dist_coeff": [[0.1, 0.2, 0.3, 0.4, 0.5]]}"""
    camera = load_text(tmp_path, text)
    assert (camera.focal_px, camera.center_px) == ((5.0, 6.0), (1.0, 2.0))
    assert camera.lens == BrownLens((0.1, 0.2, 0.3, 0.4, 0.5))


@pytest.mark.parametrize(
    ("lens", "model", "count"),
    [
        (BrownLens(), "plumb_bob", 5),
        (BrownLens((0.1,) * 4), "plumb_bob", 5),
        (BrownLens((0.1,) * 5), "plumb_bob", 5),
        (BrownLens((0.1,) * 8), "rational_polynomial", 8),
        (BrownLens((0.1,) * 14), "rational_polynomial", 14),
        (FisheyeLens(), "equidistant", 4),
    ],
)
def test_ros_readers_find_their_fields(tmp_path: Path, lens: Lens, model: str, count: int) -> None:
    save_camera(Camera(640, 480, (500.0, 501.0), (319.0, 239.0), lens), tmp_path / "cam.yaml")
    found = yaml.safe_load((tmp_path / "cam.yaml").read_text())
    assert (found["distortion_model"], found["distortion_coefficients"]["cols"]) == (model, count)
    K = [500.0, 0.0, 319.0, 0.0, 501.0, 239.0, 0.0, 0.0, 1.0]
    P = [500.0, 0.0, 319.0, 0.0, 0.0, 501.0, 239.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    assert found["camera_matrix"] == {"rows": 3, "cols": 3, "data": K}
    assert found["projection_matrix"] == {"rows": 3, "cols": 4, "data": P}
    assert found["rectification_matrix"]["data"] == np.eye(3).ravel().tolist()
