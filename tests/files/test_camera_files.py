"""Camera files: what is written reads back, what others write is understood, the rest refused."""

import contextlib
import dataclasses
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.errors import InputError
from tagmetry.files import CameraFormat, load_camera, save_camera
from tagmetry.files.camera import _camera, _text
from tagmetry.files.tables import parse_table

FINITE = st.floats(allow_nan=False, allow_infinity=False)
POSITIVE = st.floats(min_value=1e-300, allow_infinity=False)
TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=30)


def lenses(*counts: int) -> st.SearchStrategy[Lens]:
    brown = [st.tuples(*[FINITE] * count).map(BrownLens) for count in counts]
    return st.one_of(*brown, st.tuples(*[FINITE] * 4).map(FisheyeLens))


@st.composite
def cameras(draw: st.DrawFn, *counts: int) -> Camera:
    lens = draw(lenses(*counts))
    size = 4 + len(lens.coefficients)
    half = np.random.default_rng(draw(st.integers(0, 1000))).normal(size=(size, size))
    return Camera(
        draw(st.integers(1, 50_000)),
        draw(st.integers(1, 50_000)),
        draw(st.tuples(POSITIVE, POSITIVE)),
        draw(st.tuples(FINITE, FINITE)),
        lens,
        covariance=draw(st.sampled_from([None, half @ half.T])),
        zoom=draw(POSITIVE),
        focus=draw(st.none() | FINITE),
        name=draw(TEXTS),
        provenance=draw(TEXTS),
    )


def assert_equal(found: Camera, expected: Camera) -> None:
    assert str(found.lens) == str(expected.lens)
    for field in ("size_px", "focal_px", "center_px", "zoom", "focus", "name", "provenance"):
        assert repr(getattr(found, field)) == repr(getattr(expected, field))
    if expected.covariance is None:
        assert found.covariance is None
    else:
        np.testing.assert_array_equal(found.covariance, expected.covariance)


@given(cameras(0, 4, 5, 8, 12, 14))
@pytest.mark.parametrize(("form", "suffix"), [("ros", ""), ("opencv", ""), ("opencv", ".json")])
def test_camera_reads_back_exactly(form: CameraFormat, suffix: str, camera: Camera) -> None:
    assert_equal(_camera(parse_table(_text(camera, form, suffix)), None), camera)


@given(cameras(0, 4))
def test_kalibr_camera_reads_back_exactly(camera: Camera) -> None:
    assert_equal(_camera(parse_table(_text(camera, "kalibr", "")), None), camera)


FULL = Camera(
    1920,
    1080,
    (1400.1, 1401.2),
    (959.3, 1e-7),
    BrownLens((-0.3, 0.1, 1e-5, -2e-4)),
    covariance=np.diag(np.arange(1.0, 9.0)),
    zoom=2.0,
    focus=35.5,
    name="ceiling: north",
    provenance='calibrated "by hand",\n2 views',
)


@pytest.mark.parametrize("form", ["ros", "opencv", "kalibr"])
def test_file_reads_back(tmp_path: Path, form: CameraFormat) -> None:
    save_camera(FULL, tmp_path / "cam.yaml", form)
    assert_equal(load_camera(tmp_path / "cam.yaml"), FULL)


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


ROS = """\
image_width: 640
image_height: 480
camera_name: 00314159
camera_matrix:
  rows: 3
  cols: 3
  data: [739.08, 0, 321.5, 0, 740.12, 1e2, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.36, 0.13, 4.6e-05, -1e-3, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
"""

KALIBR = """\
cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
  distortion_model: radtan
  intrinsics: [458.654, 457.296, 367.215, 248.375]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [0.01, -0.02, 0.003, -0.0004]
  distortion_model: equidistant
  intrinsics: [457.587, 456.134, 379.999, 255.238]
  resolution: [752, 481]
  rostopic: /cam1/image_raw
"""

OPENCV = """\
%YAML:1.0
---
image_width: 640
image_height: 480
fisheye_model: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.0e+02, 0., 3.2e+02, 0., 5.0e+02, 2.4e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 4
   cols: 1
   dt: d
   data: [ 1.0e-01, 0., 0., 0. ]
"""


def load_text(tmp_path: Path, text: str, name: str | None = None) -> Camera:
    path = tmp_path / "cam.yaml"
    path.write_text(text)
    return load_camera(path, name)


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


def _mutated(draw: st.DrawFn, text: str) -> str:
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(text)))
        length = draw(st.integers(0, 12))
        patch = draw(
            st.text(max_size=4)
            | st.sampled_from(["[", "}", "- ", "&a ", "*a", "!!x ", "1e999", ".nan", "-", "null"])
        )
        text = text[:start] + patch + text[start + length :]
    return text


@given(st.data())
@settings(max_examples=400)
def test_damaged_file_is_read_or_refused(data: st.DataObject) -> None:
    text = data.draw(st.composite(_mutated)(data.draw(st.sampled_from([ROS, KALIBR, OPENCV]))))
    with contextlib.suppress(InputError):
        assert _camera(parse_table(text), None).width_px >= 1
