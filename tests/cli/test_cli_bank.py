"""`tagmetry camera bank` and `show`: calibrations in, the camera between them out."""

import json
from pathlib import Path

import numpy as np
import pytest

from tagmetry.camera import BrownLens, Camera, zoomed
from tagmetry.cli.main import run
from tagmetry.files import load_bank, load_camera, save_camera

FOCI = (0, 10, 20, 40, 50)


def camera(focus: float, focal_px: float | None = None) -> Camera:
    focal_px = 1000 + focus if focal_px is None else focal_px
    lens = BrownLens((-0.1 + focus / 1000, 0.01, 0.0, 0.0))
    deviations = np.array([0.5, 0.5, 0.3, 0.3, 1e-3, 1e-3, 1e-5, 1e-5])
    covariance = np.diag(deviations**2)
    return Camera(
        1280,
        720,
        (focal_px, focal_px),
        (640.0, 360.0),
        lens,
        covariance,
        focus=focus,
        name="webcam",
    )


@pytest.fixture
def calibrations(tmp_path: Path) -> list[str]:
    for focus in FOCI:
        save_camera(camera(focus), tmp_path / f"{focus}.yaml")
    return [f"--add={tmp_path / f'{focus}.yaml'}" for focus in FOCI]


@pytest.fixture
def bank(calibrations: list[str], tmp_path: Path, capsys: pytest.CaptureFixture) -> str:
    path = str(tmp_path / "bank.yaml")
    assert run(["camera", "bank", path, "--digital-zoom", "--may-scale", *calibrations]) == 0
    assert capsys.readouterr().out == f"wrote bank of 5 -> {path}\n"
    return path


def test_the_bank_holds_what_was_added(bank: str) -> None:
    found = load_bank(bank)
    assert [node.focus for node in found.nodes] == list(FOCI)
    assert (found.zoom_is_digital, found.may_scale) == (True, True)
    np.testing.assert_array_equal(found.nodes[1].camera.covariance, camera(10).covariance)


def test_gives_the_camera_between(bank: str, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    out, before = tmp_path / "out.yaml", Path(bank).read_bytes()
    assert run(["camera", "bank", bank, "--at", "focus=15, zoom=2", "--out", str(out)]) == 0
    assert capsys.readouterr().out == f"wrote 1280x720 camera -> {out}\n"
    found = load_camera(out)
    assert (found.focus, found.zoom) == (15.0, 2.0)
    expected = zoomed(load_bank(bank).camera_at(focus=15), 2.0)
    assert found.focal_px == pytest.approx(expected.focal_px, rel=1e-12)
    assert found.focal_px[0] == pytest.approx(2 * 1015, abs=0.1)
    assert found.covariance is not None
    assert Path(bank).read_bytes() == before


def test_prints_the_camera_without_an_out(bank: str, capsys: pytest.CaptureFixture) -> None:
    assert run(["camera", "bank", bank, "--at", "focus=20,size=640x360"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("webcam: 640x360, brown lens")
    assert "fx           510 ± 0.25" in out


def test_shows_calibrations_gaps_and_how_each_is_predicted(
    bank: str, capsys: pytest.CaptureFixture
) -> None:
    assert run(["camera", "show", bank]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "webcam: 5 calibrations at 1280x720, digital zoom"
    assert len(lines) == 2 + 5 + 1
    assert lines[2].endswith("1000.00     640.00     360.00  -")
    assert "px worst" in lines[3]
    assert "GAP: no calibration between focus 20 and 40 (1280x720, zoom 1)" in lines[-1]
    assert "; half way the focal length is known to " in lines[-1]
    assert "ONLY TWO" not in "".join(lines)
    assert run(["camera", "show", bank, "--step", "20"]) == 0
    assert "GAP" not in capsys.readouterr().out


def test_a_bank_of_two_is_told_that_it_cannot_know_what_lies_between(
    calibrations: list[str], tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    path = str(tmp_path / "two.yaml")
    assert run(["camera", "bank", path, calibrations[0], calibrations[-1]]) == 0
    assert run(["camera", "show", path]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert "ONLY TWO, at focus 0 and 50: nothing tells how the camera bends between them" in last
    assert last.endswith(
        "half way the focal length is known to 1.4 % (one deviation); calibrate between"
    )


def test_shows_json(bank: str, capsys: pytest.CaptureFixture) -> None:
    assert run(["camera", "show", bank, "--json"]) == 0
    table = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert [row["focus"] for row in table["calibrations"]] == list(FOCI)
    assert [row["focus"] for row in table["leave_one_out"]] == [10, 20, 40]
    assert [(gap["low_focus"], gap["high_focus"]) for gap in table["gaps"]] == [(20, 40)]
    assert table["repeats"] == []


def test_adds_repeats_and_drops(bank: str, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    again = tmp_path / "again.yaml"
    save_camera(camera(20, 1021.0), again)
    assert run(["camera", "bank", bank, "--add", str(again), "--approach", "from far"]) == 0
    assert run(["camera", "show", bank]) == 0
    out = capsys.readouterr().out
    assert "focus 20 (zoom 1) was calibrated 2 times: up to" in out
    assert "  from far\n" in out
    assert run(["camera", "bank", bank, "--drop", "focus=20"]) == 0
    assert [node.focus for node in load_bank(bank).nodes] == [0, 10, 40, 50]


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--at=focus=60"], "focus 60 lies outside 0 to 50"),
        (["--at=focus=10,zoom=0.5"], "digital zoom of 0.5 was asked for"),
        (["--at=zoom=2"], "expected a setting with its focus, like focus=35"),
        (["--at=fokus=2"], "expected a setting like focus=35,zoom=200,size=1920x1080, found"),
        (["--at=focus=two"], "focus: expected a number, found 'two'"),
        (["--at=focus=1,focus=2"], "expected a setting like"),
        (["--at=focus=1,size=640"], "expected pixels like 1920x1080, found '640'"),
        (["--at=focus=1,size=640x480"], "no calibration for 640x480 images of that shape"),
        (["--out=x.yaml"], "say at which setting, as --at focus=35"),
        (["--drop=focus=15"], "there is no calibration at focus 15"),
        (["--approach=from near"], "--approach says how the calibrations of --add"),
        (["--add=none.yaml"], "none.yaml: there is no such file"),
    ],
)
def test_refuses(bank: str, options: list[str], text: str, capsys: pytest.CaptureFixture) -> None:
    before = Path(bank).read_bytes()
    assert run(["camera", "bank", bank, *options]) == 2
    err = capsys.readouterr().err
    assert text in err
    assert err.count("\n") == 1
    assert Path(bank).read_bytes() == before


def test_refuses_a_calibration_without_focus(
    bank: str, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    path = tmp_path / "plain.yaml"
    save_camera(Camera(1280, 720, (1000.0, 1000.0), (640.0, 360.0), name="webcam"), path)
    assert run(["camera", "bank", bank, "--add", str(path)]) == 2
    assert f"{path}: a calibration in a bank needs the focus" in capsys.readouterr().err


def test_refuses_a_bank_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    path = tmp_path / "none.yaml"
    assert run(["camera", "bank", str(path), "--at", "focus=1"]) == 2
    assert "there is no such bank; begin one with --add CAMERA" in capsys.readouterr().err
    assert run(["camera", "show", str(path)]) == 2
    assert "there is no such file" in capsys.readouterr().err
