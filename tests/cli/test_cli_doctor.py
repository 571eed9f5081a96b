"""`tagmetry doctor` prints a block or a JSON line per picture; only unusable input is an error."""

import json
import re

import cv2
import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.cli.main import run
from tagmetry.files import save_camera
from tagmetry.markers import family


@pytest.fixture
def photo(tmp_path):
    cells = np.pad(family("tag36h11").picture(7), 2, constant_values=True)
    grey = np.kron(cells, np.full((15, 15), 255)).astype(np.uint8)
    path = tmp_path / "photo.png"
    cv2.imwrite(str(path), np.pad(grey, 60, constant_values=150))
    return path


@pytest.fixture
def camera(tmp_path):
    path = tmp_path / "cam.yaml"
    save_camera(Camera(300, 300, (400.0, 400.0), (149.5, 149.5)), path)
    return path


def test_a_block_per_picture_whatever_is_found(photo, capsys) -> None:
    assert run(["doctor", str(photo), str(photo), "--family", "4x4_50"]) == 0
    block = (
        f"{photo} (300x300)\n"
        "  problem: another family: tag36h11 id 7 in the picture; asked for was 4x4_50\n"
        "           -> --family tag36h11\n"
    )
    assert capsys.readouterr().out == 2 * block


def test_json(photo, capsys) -> None:
    assert run(["doctor", str(photo), "--json"]) == 0
    line = json.loads(capsys.readouterr().out)
    assert (line["source"], line["width"], line["height"]) == (str(photo), 300, 300)
    assert line["advice"] == [
        {
            "severity": "ok",
            "title": "found",
            "explanation": "tag36h11 id 7, sides of 120 px",
            "remedy": "",
        }
    ]


@pytest.mark.parametrize(
    ("size", "says"),
    [("120mm", None), ("7=120mm", None), ("8=120", None), ("120", "would be 400 m away")],
)
def test_sizes_are_judged_by_the_distance(photo, camera, size, says, capsys) -> None:
    assert run(["doctor", str(photo), "--camera", str(camera), "--size", size]) == 0
    out = capsys.readouterr().out
    assert "ok:      the calibration fits the picture: 300x300" in out
    assert ("implausible distance" in out) == (says is not None)
    assert says is None or says in out


def test_a_calibration_of_another_size_is_an_answer_not_an_error(photo, tmp_path, capsys) -> None:
    path = tmp_path / "other.yaml"
    save_camera(Camera(600, 600, (800.0, 800.0), (299.5, 299.5)), path)
    assert run(["doctor", str(photo), "--camera", str(path), "--size", "0.12"]) == 0
    out = capsys.readouterr().out
    assert out.index("problem: a calibration of another resolution") < out.index("ok:")
    assert "a factor of 0.5" in out


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["missing.png"], "missing.png"),
        (["PHOTO", "--family", "tag99"], "unknown marker family 'tag99'; there are"),
        (["PHOTO", "--size", "0.1"], "give --camera too"),
        (["PHOTO", "--camera", "CAMERA", "--size", "nan"], "expected a length above 0"),
        (["TINY"], r"tiny\.png: an image of 1x1 pixels is too small"),
        ([], "PICTURE"),
    ],
)
def test_unusable_input_is_one_line(arguments, says, photo, camera, tmp_path, capsys) -> None:
    tiny = tmp_path / "tiny.png"
    cv2.imwrite(str(tiny), np.zeros((1, 1), np.uint8))
    places = {"PHOTO": str(photo), "CAMERA": str(camera), "TINY": str(tiny)}
    assert run(["doctor", *(places.get(one, one) for one in arguments)]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert re.search(says, error)
