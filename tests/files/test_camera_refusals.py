"""Camera files that are refused: with the file, the key, and what was expected."""

from pathlib import Path

import numpy as np
import pytest
from camera_examples import FULL, KALIBR, OPENCV, ROS, load_text

from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.files import save_camera


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("image_width: 640\n", "", "image_width is missing"),
        ("640", "640.5", "image_width: expected a valid integer, found 640.5"),
        ("640", "0", "image size must be positive, got 0x480"),
        ("739.08", "-739.08", "focal_px must be positive"),
        ("739.08", ".nan", r"camera_matrix\.data\.0: expected a valid number, found '\.nan'"),
        ("739.08", "1e999", "line 7: the number 1e999 is too large"),
        ("739.08, 0,", "739.08, 0.5,", r"skew of 0\.5 px"),
        ("0, 0, 1]\ndis", "0, 0, 2]\ndis", r"expected a camera matrix \[\[fx, 0, cx\]"),
        ("739.08, 0, 321.5, 0", "739.08, 0, 321.5, 1", r"expected a camera matrix \[\[fx"),
        ("739.08, ", "", r"camera_matrix: expected rows \* cols = 3 \* 3 numbers, found 8"),
        ("rows: 3\n  cols: 3", "rows: 1\n  cols: 9", "expected a 3x3 camera matrix, found 1x9"),
        ("plumb_bob", "omni", "'omni' is not known; there are plumb_bob, rational_polynomial, equ"),
        ("plumb_bob", "''", "distortion model '' is not known"),
        ("plumb_bob", "equidistant", "a fisheye lens has 4 distortion coefficients, got 5"),
        ("cols: 5\n  data: [", "cols: 6\n  data: [0, ", "expected 0, 4, 5, 8, 12 or 14"),
        ("camera_name: 00314159", "tagmetry: {zom: 2}", "tagmetry: there is no key 'zom'; .* zoom"),
        ("camera_name: 00314159", "tagmetry: {zoom: -1}", r"zoom must be positive, got -1\.0"),
        ("camera_name: 00314159", "tagmetry: {coefficient_count: 4.5}", "valid integer"),
        ("camera_name: 00314159", "tagmetry: {coefficient_count: 2}", "those after it must be 0"),
        ("camera_name: 00314159", "tagmetry: {coefficient_count: -1}", "coefficient_count is -1"),
        ("camera_name: 00314159", "tagmetry: {covariance: [[1, 2]]}", "expected a square"),
        ("camera_name: 00314159", "tagmetry: {covariance: []}", "expected a square"),
        ("camera_name: 00314159", "tagmetry: {covariance: [[1]]}", r"shape \(9, 9\)"),
        ("camera_name: 00314159", "tagmetry: {covariance: [[-1]]}", "variances of at least 0"),
        ("camera_name: 00314159", "tagmetry: {covariance: [[1, 2], [3, 1]]}", "symmetric"),
        (
            "camera_name: 00314159",
            "tagmetry: {covariance: [[1, 2], [2, 1]]}",
            "at most the product",
        ),
        ("camera_name: 00314159", "tagmetry: 7", "tagmetry: expected keys with values, found 7"),
    ],
)
def test_refuses_ros(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in ROS
    with pytest.raises(InputError, match=rf"cam\.yaml: .*{message}") as caught:
        load_text(tmp_path, ROS.replace(old, new, 1))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("pinhole", "omni", "cam0: expected the camera model pinhole, found 'omni'"),
        ("radtan", "fov", "cam0: the distortion model 'fov' is not known"),
        ("458.654, ", "", "cam0: intrinsics: expected 4 numbers, found 3"),
        ("752, 480", "752", "cam0: resolution: expected 2 numbers, found 1"),
        ("0.00019359, ", "", "cam0: distortion_coeffs: expected 4 numbers, found 3"),
        ("  resolution: [752, 480]\n", "", "cam0: resolution is missing"),
    ],
)
def test_refuses_kalibr(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in KALIBR
    with pytest.raises(InputError, match=message):
        load_text(tmp_path, KALIBR.replace(old, new, 1))


def test_refuses_a_camera_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no camera 'cam2'; there are cam0, cam1"):
        load_text(tmp_path, KALIBR, "cam2")
    with pytest.raises(InputError, match="there is no camera 'cam0'; there is 00314159"):
        load_text(tmp_path, ROS, "cam0")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("image_width: 640\n", "", r"yaml: image_width missing: .*add the size"),
        ("image_width: 640\nimage_height: 480\n", "", "image_width and image_height missing"),
        ("distortion_c", "other_c", "distortion_coefficients is missing"),
        ("rows: 4", "rows: 5", r"rows \* cols = 5 \* 1 numbers, found 4"),
        ("rows: 4\n   cols: 1", "rows: 2\n   cols: 2", "expected one row of distortion .* 2x2"),
    ],
)
def test_refuses_opencv(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in OPENCV
    with pytest.raises(InputError, match=message):
        load_text(tmp_path, OPENCV.replace(old, new, 1))


def test_refuses_rows_that_differ_in_length(tmp_path: Path) -> None:
    text = OPENCV[: OPENCV.index("distortion")] + "distortion_coefficients: [[1, 2], [3]]"
    with pytest.raises(InputError, match="distortion_coefficients: the rows differ in length"):
        load_text(tmp_path, text)


def test_refuses_a_file_that_is_no_camera(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"expected a camera file \(ROS .* the keys a, b"):
        load_text(tmp_path, "a: 1\nb: 2")


def test_kalibr_has_no_place_for_five_coefficients(tmp_path: Path) -> None:
    camera = Camera(640, 480, (500.0, 500.0), (320.0, 240.0), BrownLens((0.1,) * 5))
    with pytest.raises(InputError, match="radtan has 4 distortion coefficients, this camera has 5"):
        save_camera(camera, tmp_path / "cam.yaml", "kalibr")
    assert not (tmp_path / "cam.yaml").exists()


def test_refuses_to_write_what_cannot_be_read(tmp_path: Path) -> None:
    camera = Camera(640, 480, (500.0, 500.0), (320.0, 240.0), covariance=np.full((4, 4), np.nan))
    for form, name in (("ros", "c.yaml"), ("opencv", "c.json")):
        with pytest.raises(InputError, match=r"finite|\.nan"):
            save_camera(camera, tmp_path / name, form)  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


def test_refuses_an_unknown_format(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="'svo'; there are ros, opencv, kalibr"):
        save_camera(FULL, tmp_path / "cam.yaml", "svo")  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"the format ros is YAML; name the file \.yaml"):
        save_camera(FULL, tmp_path / "cam.json")
