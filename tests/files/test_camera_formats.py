"""mrcal, PhotonVision and COLMAP: their own files are understood, their pixels are ours after."""

import ast
import contextlib
import dataclasses
import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.errors import InputError
from tagmetry.files import CameraFormat, load_camera, save_camera
from tagmetry.files.camera import _camera_of, _text

MRCAL = """\
# generated on 2026-11-22 12:00:00 with   mrcal-calibrate-cameras
{
    'lensmodel':  'LENSMODEL_OPENCV8',

    # intrinsics are fx,fy,cx,cy,distortion0,distortion1,....
    'intrinsics': [ 1761.5, 1761.25, 1965.5, 1087.75, -0.0125, 0.25, -3.5e-05, 1e-4, 0.1, 0.2, 0.3, 0.4,],

    'valid_intrinsics_region': [ [ -1.5, 0 ], [ 10, 20 ], ],

    # extrinsics are rt_fromref
    'extrinsics': [ 2e-2, -3.e-1, -1.e-2, 1., 2.1, -3., ],

    'imagersize': [ 3904, 2160,],

    'icam_intrinsics': 0,
    'optimization_inputs': b'P{Kz<w[]2"{{[[#',
}
"""  # noqa: E501

PHOTONVISION = """\
{"resolution":{"width":1280.0,"height":720.0},
 "cameraIntrinsics":{"rows":3,"cols":3,"type":6,
  "data":[907.5,0.0,604.25,0.0,907.75,352.5,0.0,0.0,1.0]},
 "distCoeffs":{"rows":1,"cols":5,"type":6,"data":[0.11,-0.2,0.001,-0.002,0.03]},
 "calobjectWarp":[1.0E-4,2.0E-4],"observations":[{"locationInImageSpace":[{"x":1.0,"y":2.0}]}],
 "calobjectSize":{"width":8.0,"height":8.0},"calobjectSpacing":0.0254,
 "lensmodel":"LENSMODEL_OPENCV"}
"""

COLMAP = """\
# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 3
1 SIMPLE_PINHOLE 3072 2304 2559.5 1536 1152
2 OPENCV 640 480 500.5 501.5 320 240 -0.1 0.02 0.001 -0.002
7 SIMPLE_RADIAL_FISHEYE 640 480 300.25 320.5 240.5 0.01
"""

FULL = Camera(
    1920,
    1080,
    (1400.1, 1401.2),
    (959.3, 539.75),
    BrownLens((-0.3, 0.1, 1e-5, -2e-4, 0.01, 0.02, 0.03, -0.04)),
    covariance=np.diag(np.arange(1.0, 13.0)) / 3,
    zoom=2.0,
    focus=35.5,
    name="ceiling: north 'é'",
    provenance='calibrated "by hand",\n2 views',
)
FORMS: list[CameraFormat] = ["mrcal", "photonvision", "colmap"]
NAMES = {"mrcal": "c.cameramodel", "photonvision": "c.json", "colmap": "cameras.txt"}
OURS = {
    "mrcal": [0, 4, 5, 8, 12],
    "photonvision": [0, 4, 5, 8, 12, 14],
    "colmap": [0, 4, 5, 8],
}
CASES = [(form, count) for form in FORMS for count in OURS[form]]


def read(folder: Path, text: str, name: str | None = None) -> Camera:
    path = folder / "camera"
    path.write_text(text)
    return load_camera(path, name)


@pytest.mark.parametrize(("form", "count"), CASES)
def test_reads_back(tmp_path: Path, form: CameraFormat, count: int) -> None:
    numbers = np.random.default_rng(count).normal(size=count)
    lens = BrownLens(tuple(float(number) for number in numbers))
    camera = dataclasses.replace(FULL, lens=lens, covariance=np.eye(4 + count) / 7)
    save_camera(camera, tmp_path / NAMES[form], form)
    found = load_camera(tmp_path / NAMES[form])
    assert found.lens == lens
    assert (found.focal_px, found.size_px) == (camera.focal_px, camera.size_px)
    assert found.center_px == pytest.approx(camera.center_px, rel=1e-15)
    np.testing.assert_array_equal(found.covariance, camera.covariance)
    for field in ("zoom", "focus", "name", "provenance"):
        assert getattr(found, field) == getattr(camera, field)


def test_colmap_holds_a_fisheye_lens(tmp_path: Path) -> None:
    camera = dataclasses.replace(FULL, lens=FisheyeLens((0.1, 0.2, 0.3, 0.4)), covariance=None)
    save_camera(camera, tmp_path / "cameras.txt", "colmap")
    assert load_camera(tmp_path / "cameras.txt").lens == camera.lens
    assert "OPENCV_FISHEYE" in (tmp_path / "cameras.txt").read_text()


@pytest.mark.parametrize("form", ["mrcal", "photonvision"])
def test_refuses_to_write_a_fisheye_lens(tmp_path: Path, form: CameraFormat) -> None:
    camera = dataclasses.replace(FULL, lens=FisheyeLens(), covariance=None)
    with pytest.raises(InputError, match=r"fisheye .*save .* in the format ros"):
        save_camera(camera, tmp_path / NAMES[form], form)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("form", "count"), [("mrcal", 14), ("colmap", 12)])
def test_refuses_to_write_more_coefficients(tmp_path: Path, form: CameraFormat, count: int) -> None:
    camera = dataclasses.replace(FULL, lens=BrownLens((0.1,) * count), covariance=None)
    with pytest.raises(InputError, match=f"this camera has {count}"):
        save_camera(camera, tmp_path / NAMES[form], form)


@pytest.mark.parametrize("form", FORMS)
def test_refuses_the_ending_of_another_format(tmp_path: Path, form: CameraFormat) -> None:
    wrong = "c.yaml" if form == "photonvision" else "c.json"
    with pytest.raises(
        InputError, match=f"the format {form} is .*name the file .*{NAMES[form][1:]}"
    ):
        save_camera(FULL, tmp_path / wrong, form)


def test_mrcal_file(tmp_path: Path) -> None:
    camera = read(tmp_path, MRCAL)
    assert camera.size_px == (3904, 2160)
    assert (camera.focal_px, camera.center_px) == ((1761.5, 1761.25), (1965.5, 1087.75))
    assert camera.lens == BrownLens((-0.0125, 0.25, -3.5e-05, 1e-4, 0.1, 0.2, 0.3, 0.4))
    old = MRCAL.replace("'lensmodel'", "'lens_model'")
    assert read(tmp_path, old).lens == camera.lens
    as_bytes = MRCAL.replace("'lensmodel':  '", "b'lensmodel' :  b'")
    assert read(tmp_path, as_bytes).lens == camera.lens


def test_mrcal_finds_what_it_reads() -> None:
    found = ast.literal_eval(_text(FULL, "mrcal", ""))
    assert set(found) == {"lensmodel", "intrinsics", "extrinsics", "imagersize"}
    assert found["lensmodel"] == "LENSMODEL_OPENCV8"
    expected = [*FULL.focal_px, *FULL.center_px, *FULL.lens.coefficients]
    assert found["intrinsics"] == expected
    assert (found["extrinsics"], found["imagersize"]) == ([0.0] * 6, [1920, 1080])


def test_photonvision_file(tmp_path: Path) -> None:
    camera = read(tmp_path, PHOTONVISION)
    assert camera.size_px == (1280, 720)
    assert (camera.focal_px, camera.center_px) == ((907.5, 907.75), (604.25, 352.5))
    assert camera.lens == BrownLens((0.11, -0.2, 0.001, -0.002, 0.03))


def test_photonvision_finds_what_it_reads() -> None:
    found = json.loads(_text(FULL, "photonvision", ".json"))
    assert found["resolution"] == {"width": 1920.0, "height": 1080.0}
    for key, shape in (("cameraIntrinsics", (3, 3)), ("distCoeffs", (1, 8))):
        matrix = found[key]
        assert (matrix["rows"], matrix["cols"], matrix["type"]) == (*shape, cv2.CV_64FC1)
        assert len(matrix["data"]) == shape[0] * shape[1]
    assert found["observations"] == []
    assert found["lensmodel"] == "LENSMODEL_OPENCV"


def test_colmap_file(tmp_path: Path) -> None:
    first = read(tmp_path, COLMAP)
    assert (first.name, first.size_px, first.lens) == ("1", (3072, 2304), BrownLens())
    assert (first.focal_px, first.center_px) == ((2559.5, 2559.5), (1535.5, 1151.5))
    second = read(tmp_path, COLMAP, "2")
    assert second.lens == BrownLens((-0.1, 0.02, 0.001, -0.002))
    assert read(tmp_path, COLMAP, "7").lens == FisheyeLens((0.01, 0.0, 0.0, 0.0))


def test_colmap_pixels_are_moved_by_half() -> None:
    """A point in COLMAP's own formula, written out here, falls half a pixel beyond ours."""
    u, v = 0.3, -0.2
    r2 = u * u + v * v
    k1, k2, p1, p2 = -0.1, 0.02, 0.001, -0.002
    radial = k1 * r2 + k2 * r2 * r2
    du = u * radial + 2 * p1 * u * v + p2 * (r2 + 2 * u * u)
    dv = v * radial + 2 * p2 * u * v + p1 * (r2 + 2 * v * v)
    theirs = np.array([500.5 * (u + du) + 320, 501.5 * (v + dv) + 240])
    ours = _camera_of(COLMAP, "2").project(np.array([u, v, 1.0]))
    np.testing.assert_allclose(theirs - ours, 0.5, atol=1e-12)


@pytest.mark.parametrize("form", ["mrcal", "photonvision"])
def test_the_pixels_of_mrcal_and_photonvision_are_opencvs(form: CameraFormat) -> None:
    points = np.random.default_rng(0).uniform([-0.5, -0.3, 1], [0.5, 0.3, 2], (20, 3))
    camera = _camera_of(MRCAL if form == "mrcal" else PHOTONVISION, None)
    distortion = np.array(camera.lens.coefficients)
    expected, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), camera.matrix, distortion)
    np.testing.assert_allclose(camera.project(points), expected[:, 0], atol=1e-8)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("OPENCV8", "CAHVOR", "lens model 'LENSMODEL_CAHVOR' is not one of this package's"),
        ("1761.5, ", "", "intrinsics: expected 12 numbers, found 11"),
        ("1761.5", "-1.0", "focal_px must be positive"),
        ("1761.5", "1e999", "expected a finite number"),
        ("1761.5", "open('x')", "line .*expected a Python literal|expected a Python literal"),
        ("1761.5", "[" * 40, "nested deeper than 32"),
        ("1761.5", "-" * 4000 + "1", "a long chain of signs"),
        ("'imagersize': [ 3904, 2160,],", "", "imagersize is missing"),
        ("3904", "0", "image size must be positive"),
        ("# generated", '# tagmetry: {"zom": 1}\n# generated', "tagmetry: .*there is no key 'zom'"),
    ],
)
def test_refuses_mrcal(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in MRCAL
    with pytest.raises(InputError, match=f"camera: .*(?:{message})") as caught:
        read(tmp_path, MRCAL.replace(old, new, 1))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("LENSMODEL_OPENCV", "LENSMODEL_STERIOGRAPHIC", "expected the lensmodel LENSMODEL_OPENCV"),
        ("1280.0", "1280.5", "resolution.width: expected a whole number of pixels, found 1280.5"),
        ('"distCoeffs"', '"other"', "distCoeffs is missing"),
        ('"cols":5', '"cols":4', r"expected rows \* cols = 1 \* 4 numbers"),
    ],
)
def test_refuses_photonvision(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in PHOTONVISION
    with pytest.raises(InputError, match=message):
        read(tmp_path, PHOTONVISION.replace(old, new, 1))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("SIMPLE_PINHOLE", "THIN_PRISM_FISHEYE", "camera 1: .*model of SIMPLE_PINHOLE, PINHOLE"),
        ("2559.5 1536", "1536", "camera 1: SIMPLE_PINHOLE has 3 parameters, found 2"),
        ("2559.5", "two", "camera 1: expected a number, found 'two'"),
        ("2559.5", "nan", "camera 1: expected a number, found 'nan'"),
        ("3072", "3072.5", "WIDTH: expected a whole number of pixels"),
    ],
)
def test_refuses_colmap(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in COLMAP
    with pytest.raises(InputError, match=message):
        read(tmp_path, COLMAP.replace(old, new, 1))


def test_refuses_a_colmap_camera_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no camera '3'; there are 1, 2, 7"):
        read(tmp_path, COLMAP, "3")


@st.composite
def damaged(draw: st.DrawFn, text: str) -> str:
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(text)))
        patch = draw(
            st.text(max_size=4) | st.sampled_from(["[", "}", "-", "1e999", "'", "b'", "{"])
        )
        text = text[:start] + patch + text[start + draw(st.integers(0, 12)) :]
    return text


@given(st.data())
@settings(max_examples=300)
def test_damaged_file_is_read_or_refused(data: st.DataObject) -> None:
    text = data.draw(damaged(data.draw(st.sampled_from([MRCAL, PHOTONVISION, COLMAP]))))
    with contextlib.suppress(InputError):
        assert _camera_of(text, None).width_px >= 1
