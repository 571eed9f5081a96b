"""`tagmetry demo`: measured against the truth of the scene, and what it writes."""

import json
import os
import re
import time
import webbrowser
from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import Scene

from tagmetry.cli import demo as demo_module
from tagmetry.cli import display as display_module
from tagmetry.cli.main import run
from tagmetry.files import load_camera
from tagmetry.pipeline.demonstration import demonstrate
from tagmetry.record import read_results
from tagmetry.twin import showcase

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))
WRITTEN = ["camera.yaml", "markers.csv", "markers.jsonl", "overlay.png", "sheet.pdf"]
needs_data = pytest.mark.skipif(not DATA.is_dir(), reason=f"no pictures in {DATA}")


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_every_marker_lies_within_its_stated_deviations(tmp_path: Path) -> None:
    done = [demonstrate(tmp_path, np.random.default_rng(seed)) for seed in range(5)]
    for one in done:
        assert [c.id for c in one.comparisons] == [0, 1, 2, 3, 10, 13, 14]
        assert one.missing == ()
        assert max(c.distance for c in one.comparisons) < 5
        assert max(np.linalg.norm(c.error_m) for c in one.comparisons) < 0.0005
    distances = np.array([[c.distance for c in one.comparisons] for one in done])
    # Six when the covariance is exact; of 35 poses the mean is known to 0.6.
    assert 3.5 < (distances**2).mean() < 8.5


def test_writes_what_it_says_twice(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    folder = tmp_path / "new" / "demo"
    for _ in range(2):
        assert run(["demo", "--out", str(folder)]) == 0
        out = capsys.readouterr().out
        told = out.splitlines()[-1].removeprefix("wrote ").split(", ")
        assert sorted(Path(name).name for name in told) == WRITTEN
        assert names(folder) == WRITTEN
        assert "7 markers measured in a rendered picture" in out
    assert load_camera(folder / "camera.yaml").focal_px == showcase.CAMERA.focal_px
    (result,) = read_results(folder / "markers.jsonl")
    assert len(result.markers) == 7
    assert cv2.imread(str(folder / "overlay.png")).shape == (720, 1280, 3)
    assert (folder / "sheet.pdf").read_bytes().startswith(b"%PDF")
    assert len((folder / "markers.csv").read_text().splitlines()) == 8


@pytest.mark.parametrize("has_browser", [True, False])
def test_then_films_robots_where_there_is_no_screen(
    has_browser: bool,
    tmp_path: Path,
    capsys: pytest.CaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    av = pytest.importorskip("av", reason="a video needs the part `video`")
    pytest.importorskip("mujoco", reason="simulated robots need the part `robots`")
    monkeypatch.setattr(demo_module, "_FILM_S", 0.5)
    monkeypatch.setattr(display_module, "has_browser", lambda: has_browser)
    wish = ["--headless"] if has_browser else []
    assert run(["demo", "--live", *wish, "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert "7 markers measured in a rendered picture" in out
    assert "places within" in out
    assert out.splitlines()[-1] == f"wrote {tmp_path / 'arena.mp4'}"
    with av.open(str(tmp_path / "arena.mp4")) as video:
        assert sum(1 for _ in video.decode(video=0)) == 5


def test_then_serves_robots_where_there_is_a_screen(
    tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("fastapi", reason="the page needs the part `live`")
    pytest.importorskip("mujoco", reason="simulated robots need the part `robots`")
    opened: list[str] = []
    monkeypatch.setattr(display_module, "has_browser", lambda: True)
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr("tagmetry.live.opening.LivePage.serve", lambda _: time.sleep(1.5))
    assert run(["demo", "--live", "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert opened
    assert f"The live page is at {opened[0]} until" in out


@pytest.mark.parametrize(
    ("screen", "ci", "can_show"), [("", "", False), (":0", "", True), (":0", "true", False)]
)
def test_a_browser_needs_a_screen_and_a_person(
    screen: str, ci: str, can_show: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.platform", "linux")
    for name, value in (("DISPLAY", screen), ("WAYLAND_DISPLAY", ""), ("CI", ci)):
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(webbrowser, "get", lambda: None)
    assert display_module.has_browser() is can_show


def test_a_folder_that_is_a_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    (tmp_path / "file").write_text("")
    assert run(["demo", "--out", str(tmp_path / "file")]) == 2
    assert capsys.readouterr().err == f"tagmetry: {tmp_path / 'file'}: File exists\n"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--size", "60mm"], "--size says nothing without --image"),
        (["--headless"], "--headless says nothing without --live"),
    ],
)
def test_options_that_say_nothing_are_refused(
    options: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    assert run(["demo", *options, "--out", str(tmp_path / "out")]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_measures_a_picture_of_ones_own(
    scene: Scene, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    given = ["--image", scene.picture, "--camera", scene.camera, "--size", "12cm"]
    assert run(["demo", *given, "--out", str(tmp_path / "own")]) == 0
    out = capsys.readouterr().out
    assert [int(i) for i in re.findall(r"tag36h11 (\d+) ", out)] == list(scene.ids)
    assert out.count("z ") == 7
    assert names(tmp_path / "own") == ["markers.csv", "markers.jsonl", "overlay.png"]


@needs_data
def test_a_real_picture_with_markers(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    picture = DATA / "yaw_sweep" / "test_image_multiple_01.png"
    assert run(["demo", "--image", str(picture), "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    line = json.loads((tmp_path / "markers.jsonl").read_text())
    assert {m["family"] for m in line["markers"]} == {"tag36h11"}
    assert len(line["markers"]) >= 6
    assert "Where they are in space needs --size and --camera." in out


@needs_data
def test_a_real_picture_without_markers(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    picture = DATA / "marker_free" / "100007.jpg"
    assert run(["demo", "--image", str(picture), "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert "no markers" in out
    assert f"tagmetry doctor {picture}" in out
    assert json.loads((tmp_path / "markers.jsonl").read_text())["markers"] == []
