"""`tagmetry plan` in a shell: the budget, what is solved for, and what it refuses."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.cli.main import run
from tagmetry.files import save_camera


@pytest.fixture(scope="module")
def camera_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("plan") / "camera.yaml"
    spread = np.diag([0.5, 0.5, 0.4, 0.4]) ** 2
    save_camera(Camera(640, 480, (600.0, 600.0), (319.5, 239.5), covariance=spread), path)
    return path


def said(capsys: pytest.CaptureFixture, *arguments: object) -> str:
    assert run(["plan", *map(str, arguments)]) == 0
    return capsys.readouterr().out


def test_the_budget_as_text(camera_file: Path, capsys: pytest.CaptureFixture) -> None:
    text = said(capsys, "--camera", camera_file, "--size", "12cm", "--distance", 2)
    assert text.startswith("tag36h11 of 120 mm at 2 m, tilted 30°, in 640x480 px\n")
    rows = {line[:24].strip(): line[24:].split() for line in text.splitlines()}
    parts = [float(rows[name][0]) for name in ("noise of the corners", "calibration")]
    parts.append(float(rows["size of the marker"][0]))
    assert parts[2] == pytest.approx(1000 * 2 * 0.05 / 120, rel=0.01)
    assert float(rows["all"][0]) == pytest.approx(
        np.hypot(np.hypot(*parts[:2]), parts[2]), rel=0.01
    )
    assert "found up to" in text


def test_json_holds_the_same(camera_file: Path, capsys: pytest.CaptureFixture) -> None:
    text = said(capsys, "--camera", camera_file, "--size", 0.12, "--distance", 2, "--json")
    table = json.loads(text)
    parts = (table["by_corners"], table["by_calibration"], table["by_size"])
    squares = sum(part["position_m"] ** 2 for part in parts)
    assert table["all"]["position_m"] ** 2 == pytest.approx(squares)
    assert np.trace(np.array(table["covariance"])[:3, :3]) == pytest.approx(squares)
    assert table["solved_for"] is None


@pytest.mark.parametrize(
    ("given", "free", "words"),
    [
        (("--size", "12cm"), "distance", "the greatest distance that will do"),
        (("--distance", "1.5"), "size", "the smallest marker that will do"),
        (("--size", "12cm", "--distance", "1.5"), "resolution", "the fewest pixels that will do"),
    ],
)
def test_what_is_left_out_is_solved_for(
    given: tuple[str, ...], free: str, words: str, camera_file: Path, capsys: pytest.CaptureFixture
) -> None:
    arguments = ("--camera", camera_file, *given, "--want", "2.5mm")
    assert words in said(capsys, *arguments)
    table = json.loads(said(capsys, *arguments, "--json"))
    assert table["solved_for"] == free
    assert table["all"]["position_m"] <= 0.0025


def test_the_working_volume_is_drawn(
    camera_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    pytest.importorskip("matplotlib")
    path = tmp_path / "volume.png"
    said(capsys, "--camera", camera_file, "--size", "3cm", "--distance", 0.6, "--picture", path)
    pixels = cv2.imread(str(path))
    assert pixels is not None
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 100


def test_a_camera_without_covariance_and_a_marker_too_far_away(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    path = tmp_path / "bare.yaml"
    save_camera(Camera(640, 480, (600.0, 600.0), (319.5, 239.5)), path)
    arguments = ("--camera", path, "--size", 0.02, "--distance", 2, "--speed", 0.1)
    text = said(capsys, *arguments)
    assert "unknown: the camera file holds no covariance" in text
    assert "WARNING: it will mostly not be found here" in text
    assert "moves 0.3 px while the shutter is open" in text
    assert json.loads(said(capsys, *arguments, "--json"))["by_calibration"] is None


@pytest.mark.parametrize(
    ("given", "why"),
    [
        (("--size", "12cm"), "expected --size and --distance, or --want with at least one"),
        (("--want", "2mm"), "give --size, --distance, or both of them"),
        (("--size", "12cm", "--distance", "2", "--want", "1um"), "expected a length above 0"),
        (("--size", "12cm", "--want", "0.001mm"), "no distance gives 0.001 mm"),
        (("--size", "12cm", "--distance", "1cm"), "the image does not show all of a marker"),
        (("--size", "12cm", "--distance", "1e300"), "expected a length above 0"),
        (("--size", "12cm", "--distance", "2", "--noise", "1e300"), "noise_grey must be at most"),
        (("--size", "12cm", "--distance", "2", "--tilt", "90"), "tilt_deg must be from 0 to 85"),
        (("--size", "12cm", "--distance", "2", "--at", "middle"), "expected pixels like 320,100"),
        (("--size", "12cm", "--distance", "2", "--contrast", "300"), "0 < black < white"),
        (("--size", "12cm", "--distance", "2", "--family", "tag99"), "tag99"),
        (("--size", "12cm", "--distance", "2", "--picture", "a.jpg"), "the picture is a PNG"),
    ],
)
def test_what_it_refuses(
    given: tuple[str, ...], why: str, camera_file: Path, capsys: pytest.CaptureFixture
) -> None:
    assert run(["plan", "--camera", str(camera_file), *given]) == 2
    told = capsys.readouterr().err
    assert why in told
    assert told.count("\n") == 1
