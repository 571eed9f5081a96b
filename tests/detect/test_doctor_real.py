"""The doctor on real pictures: right where something is wrong, silent where all is well."""

import os
from pathlib import Path

import cv2
import pytest

from tagmetry.detect.doctor import diagnose
from tagmetry.markers import family

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))
pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="real pictures: set TAGMETRY_DATA")


def advice(path, *names):
    return diagnose(cv2.imread(str(DATA / path)), [family(name) for name in names])


def first(folder, pattern):
    paths = sorted((DATA / folder).glob(pattern))
    if not paths:
        pytest.skip(f"{folder} is not in TAGMETRY_DATA")
    return paths[0]


def test_good_pictures_get_no_advice() -> None:
    found = advice(first("yaw_sweep", "test_image_rotation_20.png"), "tag36h11")
    assert [(one.severity, one.title) for one in found] == [("ok", "found")]
    assert found[0].explanation.startswith("tag36h11 id 76")


def test_another_family_is_named() -> None:
    found = advice(first("planar_map", "image_14.png"), "tag36h11")
    assert [one.title for one in found] == ["another family"]
    assert "aruco_original ids 1, 2, 3, 4, 5" in found[0].explanation


def test_a_border_of_two_cells_is_named() -> None:
    found = advice(first("mocap_aprilgrid", "cam0/data/*.jpg"), "tag36h11")
    assert [one.title for one in found] == ["another width of border"]
    assert found[0].remedy.startswith("--family tag36h11_border2")


def test_inverted_board_in_a_video() -> None:
    av = pytest.importorskip("av")
    path = first("four_cameras", "charuco_calibration/calibration/extrinsic/cam_0.mp4")
    with av.open(str(path)) as video:
        image = next(f for n, f in enumerate(video.decode(video=0)) if n == 80)
    found = diagnose(image.to_ndarray(format="bgr24"), [family("4x4_50")])
    assert found[0].title == "inverted print"
    assert found[0].explanation.startswith("4x4_50 ids 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 printed")


@pytest.mark.parametrize("index", range(0, 200, 40))
def test_no_marker_there(index) -> None:
    first("marker_free", "*.jpg")
    path = sorted((DATA / "marker_free").glob("*.jpg"))[index]
    found = advice(path, "tag36h11")
    assert [(one.severity, one.title) for one in found] == [("problem", "no marker-like squares")]
