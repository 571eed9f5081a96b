"""`tagmetry calibrate`: files, lines and refusals, on real pictures and on a rendered video."""

import json
import os
import re
import signal
import subprocess
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import arguments_of

from tagmetry.camera import Camera, Image
from tagmetry.cli.main import run
from tagmetry.files import load_camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard
from tagmetry.record import open_overlay
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Still, board_thing

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))
BOARD = Chessboard(7, 5, 0.03)
ASKED = "chessboard:7x5:30mm"
TRUTH = Camera(480, 360, (520.0, 520.0), (241.0, 177.5))


@cache
def rendered() -> tuple[np.ndarray, ...]:
    """Return eleven pictures of the board, each at another place and tilt."""
    rng, pictures = np.random.default_rng(11), []
    while len(pictures) < 11:
        around, tilt = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(12, 40))
        turn = Rotation.from_rotvec(tilt * np.array([np.cos(around), np.sin(around), 0.0]))
        turn = turn * Rotation.from_euler("x", 180, degrees=True)
        place = [*rng.uniform(-0.13, 0.13, 2), rng.uniform(0.36, 0.6)]
        T = RigidTransform.from_components(place, turn)
        pixels = TRUTH.project(T.apply(BOARD.corners_m))
        if not ((pixels > 15) & (pixels < [464, 344])).all():
            continue
        scene = Scene((board_thing(BOARD, Still(T), margin_m=0.02),))
        still = Still(RigidTransform.identity())
        shot = Shot(TRUTH, still, optics=Optics(blur_px=0.6), sensor=Sensor(noise_grey=1.5))
        pictures.append(photograph(scene, shot, np.random.default_rng(len(pictures))))
    return tuple(pictures)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    home = tmp_path_factory.mktemp("pictures")
    for i, pixels in enumerate(rendered()[:7]):
        cv2.imwrite(str(home / f"{i}.png"), pixels)
    cv2.imwrite(str(home / "empty.png"), np.full((360, 480), 120, np.uint8))
    return home


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A board that is held still for three images at each place."""
    path = tmp_path_factory.mktemp("video") / "held.mp4"
    with open_overlay(path) as writer:
        for i, grey in enumerate(one for one in rendered() for _ in range(3)):
            pixels = cv2.cvtColor(grey, cv2.COLOR_GRAY2BGR)
            writer.write(Image(pixels, i / 15, "capture", sequence=i, source="twin"))
    return path


def test_real_chessboards_give_a_camera_file_with_its_covariance(tmp_path, capsys) -> None:
    pictures = DATA / "chessboard_opencv"
    if not pictures.exists():
        pytest.skip(f"no {pictures}; TAGMETRY_DATA names the data folder")
    out, report, tables = tmp_path / "c.yaml", tmp_path / "r.html", tmp_path / "t"
    files = ["--out", out, "--report", report, "--csv", tables, "--figures", tmp_path / "f"]
    asked = ["calibrate", pictures, "--board", "chessboard:9x6:25mm", *files]
    assert run([str(one) for one in asked]) == 0
    said = capsys.readouterr()
    camera = load_camera(out)
    fx, sd = camera.focal_px[0], np.sqrt(np.diag(camera.covariance))
    assert abs(fx - 533.2) < 3 * sd[0]
    assert sd[2] >= 1.2
    assert "13 views of chessboard:9x6:25mm" in camera.provenance
    hold_out = float(re.search(r"^all +\d+ +\S+ +(\S+)$", said.out, re.MULTILINE)[1])
    assert hold_out <= 0.183
    assert "next picture: hold the board" in said.out
    assert "weak: projections are uncertain" in said.out
    assert report.stat().st_size > 100_000
    assert len(list(tables.iterdir())) == 7
    assert len(list((tmp_path / "f").iterdir())) == 6


def test_json_says_the_same_as_the_file(folder, tmp_path, capsys) -> None:
    out = tmp_path / "c.yaml"
    asked = ["calibrate", str(folder), "--board", ASKED, "--model", "brown1", "--fix-aspect"]
    assert run([*asked, "--out", str(out), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    camera = load_camera(out)
    assert [p["name"] for p in told["parameters"][:4]] == ["fx", "fy", "cx", "cy"]
    assert told["parameters"][0]["value"] == camera.focal_px[0] == camera.focal_px[1]
    assert told["parameters"][0]["sd"] == pytest.approx(np.sqrt(camera.covariance[0, 0]))
    assert abs(camera.focal_px[0] - 520) < 4 * told["parameters"][0]["sd"] + 0.1
    assert [Path(one["source"]).name for one in told["rejected"]] == ["empty.png"]
    assert len(told["views"]) == 7
    assert told["choice"] is None


def test_the_few_views_that_tell_most(folder, capsys) -> None:
    asked = ["calibrate", str(folder), "--board", ASKED, "--model", "none", "--views", "5"]
    assert run([*asked, "--fix-center", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["views"]) == 5
    assert told["parameters"][2]["value"] == 239.5


@pytest.mark.parametrize(
    ("board", "says"),
    [
        ("chessboard:8x6:30mm", "squares counted instead of inner corners"),
        pytest.param(
            "charuco:7x5:30mm:22mm:5x5_100",
            "a plain chessboard is seen",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_wrong_board_is_named_and_nothing_is_written(folder, tmp_path, board, says, capsys):
    out, report = tmp_path / "c.yaml", tmp_path / "r.html"
    asked = ["calibrate", str(folder), "--board", board, "--out", str(out)]
    assert run([*asked, "--report", str(report)]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert f"board: {says}" in said.err
    assert "ask for --board chessboard:7x5:30mm" in said.err
    assert said.err.splitlines()[-1].startswith("tagmetry: expected at least 3 views")
    assert list(tmp_path.iterdir()) == []


def test_a_print_at_another_scale_is_named(folder, capsys) -> None:
    asked = ["calibrate", str(folder), "--board", ASKED, "--model", "none"]
    assert run([*asked, "--measured", "square=29.1mm"]) == 0
    assert "printed at another scale" in capsys.readouterr().out
    assert run([*asked, "--measured", "240mm"]) == 0
    assert "printed at another scale" not in capsys.readouterr().out


def test_live_says_where_to_hold_the_board_and_ends(video, tmp_path, capsys) -> None:
    out = tmp_path / "c.yaml"
    asked = ["calibrate", str(video), "--board", ASKED, "--model", "none", "--live"]
    assert run([*asked, "--uncertainty", "5px", "--out", str(out)]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0].startswith(("-> hold the board", "   "))
    taken = [line for line in said if re.match(r"view \d+ taken: \d", line)]
    assert len(taken) >= 8
    assert len({line for line in said if line.startswith("-> ")}) > 1
    assert load_camera(out).focal_px[0] == pytest.approx(520, abs=3)


def long_video(path: Path, places: int) -> Path:
    """Write a video of a board that is held at a few places, much longer than anyone looks."""
    with open_overlay(path) as writer:
        for i in range(600):
            pixels = cv2.cvtColor(rendered()[i // 3 % places], cv2.COLOR_GRAY2BGR)
            writer.write(Image(pixels, i / 15, "capture", sequence=i, source="twin"))
    return path


def interrupted_live(video: Path, out: Path, line: bytes) -> tuple[int, bytes, bytes]:
    """Send Ctrl-C after a line; return exit code, standard output and error."""
    asked = ["calibrate", str(video), "--board", ASKED, "--model", "none", "--live"]
    asked += ["--uncertainty", "0.0001px", "--out", str(out)]
    process = subprocess.Popen(arguments_of(*asked), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    said = [process.stdout.readline()]
    while said[-1] and not said[-1].startswith(line):
        said.append(process.stdout.readline())
    process.send_signal(signal.SIGINT)
    rest, err = process.communicate(timeout=120)
    return process.returncode, b"".join(said) + rest, err


def test_ctrl_c_ends_a_live_session_with_what_was_taken(tmp_path: Path) -> None:
    video = long_video(tmp_path / "long.mp4", 11)
    code, said, err = interrupted_live(video, tmp_path / "c.yaml", b"view 5 taken")
    taken = len(re.findall(rb"^view \d+ taken", said, re.MULTILINE))
    assert code == 0
    assert err.startswith(f"ended by hand after {taken} views\n".encode())
    assert taken < 11
    assert load_camera(tmp_path / "c.yaml").focal_px[0] == pytest.approx(520, abs=5)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["c.yaml", "long.mp4"]


def test_ctrl_c_before_there_are_enough_views_writes_nothing(tmp_path: Path) -> None:
    video = long_video(tmp_path / "long.mp4", 1)
    code, said, err = interrupted_live(video, tmp_path / "c.yaml", b"view 1 taken")
    assert b"view 2 taken" not in said
    assert (code, err) == (130, b"tagmetry: interrupted\n")
    assert [one.name for one in tmp_path.iterdir()] == ["long.mp4"]


def test_live_without_the_board_is_refused_with_its_reason(video, tmp_path, capsys) -> None:
    out = tmp_path / "c.yaml"
    asked = ["calibrate", str(video), "--board", "chessboard:8x6:30mm", "--live"]
    assert run([*asked, "--out", str(out)]) == 2
    assert "squares counted instead of inner corners" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--board", "chess:9x6"], "expected a board as"),
        (["--board", "chessboard:9x6"], "expected chessboard:COLUMNSxROWS"),
        (["--board", ASKED, "--model", "brown6"], "expected --model auto"),
        (["--board", ASKED, "--shape", "round"], "expected --shape flat or free"),
        (["--board", ASKED, "--report", "r.pdf"], "ending in .html"),
        (["--board", ASKED, "--out", "nowhere/c.yaml"], "there is no folder nowhere"),
        (["--board", ASKED, "--measured", "wide=1"], "expected a measured length"),
        (["--board", ASKED, "--measured", "width=1,1"], "gives 'width' twice"),
        (["--board", ASKED, "--measured", "long"], "expected a length above 0"),
        (["--board", ASKED, "--views", "2"], "--views"),
        (["--board", ASKED, "--live", "--uncertainty", "0px"], "expected an uncertainty above 0"),
        ([], "Missing option '--board'"),
    ],
)
def test_a_mistake_is_one_line(folder, options, says, capsys) -> None:
    assert run(["calibrate", str(folder), *options]) == 2
    said = capsys.readouterr()
    assert says in said.err.splitlines()[-1]
    assert said.out == ""


def test_sources_that_are_not_there_or_never_end(folder, capsys) -> None:
    assert run(["calibrate", "nothing.png", "--board", ASKED]) == 2
    assert "nothing.png" in capsys.readouterr().err
    assert run(["calibrate", str(folder), "x", "--board", ASKED, "--live"]) == 2
    assert "--live watches one source" in capsys.readouterr().err
    assert run(["calibrate", "rtsp://127.0.0.1:9/x", "--board", ASKED]) == 2
    assert "add --live" in capsys.readouterr().err
