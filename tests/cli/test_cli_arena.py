"""`tagmetry arena`: a small rendered arena calibrated, run, audited; and what is refused."""

import csv
import json
import socket
from pathlib import Path

import cv2
import numpy as np
import pytest
from small_table import CAMERA, SENSOR, T_CAMERA_WORLD, TABLE

from tagmetry.cli.main import run
from tagmetry.files import save_camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.twin import render

ARENA = TABLE.replace("0.1}}", '0.1}, key: "KEY"}').replace("KEY", "ab" * 32) + SENSOR


def marker(
    number: int, x_m: float, y_m: float, z_m: float, turn_rad: float, size_m: float
) -> MountedMarker:
    turn = Rotation.from_euler("z", turn_rad)
    at = RigidTransform.from_components([x_m, y_m, z_m], turn)
    return MountedMarker("tag36h11", number, size_m, at)


FLOOR = [marker(100, -0.5, 0.3, 0, 0, 0.1), marker(101, 0.5, 0.3, 0, 2.0, 0.1)]


def picture(markers: list[MountedMarker]) -> AnyPixels:
    return render(markers, T_CAMERA_WORLD, CAMERA, np.random.default_rng(0))


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an arena, pictures of its floor, a robot that turns, and a grid."""
    folder = tmp_path_factory.mktemp("table")
    save_camera(CAMERA, folder / "ceiling.yaml")
    (folder / "arena.yaml").write_text(ARENA, "utf-8")
    cv2.imwrite(str(folder / "floor.png"), picture(FLOOR))
    grid = [marker(10 + n, 0.2 * (n % 3 - 1), 0.1 - 0.2 * (n // 3), 0, 0.0, 0.1) for n in range(6)]
    cv2.imwrite(str(folder / "grid.png"), picture([*FLOOR, *grid]))
    (folder / "turn").mkdir()
    for n in range(8):
        f = n * np.pi / 4
        at = (0.02 * np.cos(f), 0.02 * np.sin(f))
        shown = picture([marker(1, *at, 0.1, f - np.pi / 2, 0.08)])
        cv2.imwrite(str(folder / "turn" / f"{n}.png"), shown)
    assert run(["arena", "calibrate", str(folder / "floor.png"), str(folder / "arena.yaml")]) == 0
    return folder


def arena(table: Path, *arguments: str) -> int:
    command, source, *options = arguments
    return run(["arena", command, str(table / source), str(table / "arena.yaml"), *options])


def test_calibration_tells_camera_and_floor(
    table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert arena(table, "calibrate", "floor.png") == 0
    out = capsys.readouterr().out.splitlines()
    words = out[0].split()
    assert [float(words[n]) for n in (3, 5, 7)] == pytest.approx([0.5, -0.3, 1.2], abs=1e-3)
    assert words[8:10] == ["m", "(±"]
    assert out[2].startswith("floor marker 101: x 1.000")
    assert out[-1] == f"wrote {table / 'arena.world.yaml'}"


def test_a_run_prints_a_line_for_each_image(
    table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert arena(table, "run", "turn", "--limit", "2") == 0
    said = capsys.readouterr()
    lines = [json.loads(line) for line in said.out.splitlines()]
    assert [line["sequence"] for line in lines] == [0, 1]
    assert "no floor marker is seen" in said.err
    (robot,) = lines[0]["robots"]
    assert (robot["x_m"], robot["y_m"]) == pytest.approx((0.52, -0.3), abs=1e-3)
    assert robot["heading_rad"] == pytest.approx(0.0, abs=0.01)
    assert "2 images; image to result" in said.err


def test_a_run_writes_a_file_and_warns_of_strangers(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "states.jsonl"
    assert arena(table, "run", "grid.png", "--out", str(out)) == 0
    assert len(out.read_text("utf-8").splitlines()) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert "tag36h11 id 10 is no robot's and no floor marker" in said.err


def test_simulated_robots_drive_among_those_of_the_pictures(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("mujoco")
    control = tmp_path / "mine.py"
    control.write_text(
        "from tagmetry.arena.drive import Twist\ndef control(view): return Twist(0.1, 0)\n"
    )
    options = ["--virtual", "2", "--controller", str(control), "--link", "127.0.0.1:0"]
    assert arena(table, "run", "turn", *options) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [one["name"] for one in lines[0]["robots"]] == ["ada", "virtual 2", "virtual 3"]
    driven_m = lines[-1]["robots"][1]["x_m"] - lines[0]["robots"][1]["x_m"]
    assert driven_m == pytest.approx(7 * 0.2 * 0.1, abs=0.03)  # 0.2 s of each second between
    (told, *_) = (one for one in lines[0]["told"] if one["id"] == 1)
    assert {one["id"] for one in told["neighbours"]} == {2, 3}


def test_an_audit_writes_table_and_map(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    files = [str(tmp_path / name) for name in ("errors.csv", "errors.png")]
    options = ["--grid", "3x2", "--step", "20cm", "--size", "10cm", "--first-id", "10"]
    options += ["--csv", files[0], "--picture", files[1]]
    assert arena(table, "audit", "grid.png", *options) == 0
    assert capsys.readouterr().out.startswith("6 of 6 markers: radial error 0.")
    with Path(files[0]).open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["id"] for row in rows] == ["10", "11", "12", "13", "14", "15"]
    assert all(float(row["error_m"]) < 5e-4 for row in rows)
    assert cv2.imread(files[1]) is not None
    assert arena(table, "audit", "grid.png", *options[:8], "--at", "0.5,-0.3,0") == 0
    assert "radial error 0." in capsys.readouterr().out


def test_a_turn_tells_how_the_marker_is_mounted(
    table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert arena(table, "mount", "turn", "--robot", "1") == 0
    out = capsys.readouterr().out.splitlines()
    assert out[1].startswith("forward_m: 0.0200 ") or out[1].startswith("forward_m: 0.0199 ")
    assert out[4].startswith("# by its size the marker is 0.0") or "is 0.1" in out[4]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("run", "none.png"), "none.png"),
        (("calibrate", "grid.png", "--camera", "/none.yaml"), "no such file"),
        (("mount", "turn", "--robot", "9"), "there is no robot 9 in"),
        (("mount", "floor.png", "--robot", "1"), "needs at least one image"),
        (("audit", "grid.png", "--grid", "3", "--step", "20cm", "--size", "10cm"), "like 24x15"),
        (
            ("audit", "grid.png", "--grid", "3x2", "--step", "1cm", "--size", "10cm"),
            "size below the step",
        ),
        (
            ("audit", "grid.png", "--grid", "3x2", "--step", "20cm", "--size", "9cm", "--at", "1"),
            "x,y,turn",
        ),
        (
            ("audit", "floor.png", "--grid", "3x2", "--step", "20cm", "--size", "10cm"),
            "0 of 6 are seen",
        ),
        (("run", "turn", "--link", "127.0.0.1:x"), "expected an address"),
        (("run", "turn", "--controller", "mine.py"), "hear nothing without --link"),
        (("run", "turn", "--out", "states.txt"), "states.jsonl"),
    ],
)
def test_bad_input_is_one_line(
    table: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], said: str
) -> None:
    assert arena(table, *arguments) == 2
    err = capsys.readouterr().err.strip().splitlines()
    assert len(err) == 1
    assert said in err[0]


def test_an_arena_without_world_says_how_to_measure_it(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "arena.yaml").write_text(ARENA, "utf-8")
    save_camera(CAMERA, tmp_path / "ceiling.yaml")
    assert run(["arena", "run", str(table / "turn"), str(tmp_path / "arena.yaml")]) == 2
    assert "measure it: tagmetry arena calibrate" in capsys.readouterr().err


def test_a_port_that_is_taken_is_one_line(table: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        assert arena(table, "run", "turn", "--link", f"127.0.0.1:{port}") == 2
    assert str(port) in capsys.readouterr().err


def test_a_run_with_a_link_ends(table: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert arena(table, "run", "turn", "--link", "127.0.0.1:0", "--poses", "--quiet") == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("markers: [{id: 100}, {id: 101}]", "markers: []", "floor.markers: there is none"),
        ("- {id: 1,", "- {id: 1, marker: {id: 2, height_m: 0.1}}\n  - {id: 1,", "two robots"),
        ("- {id: 1,", "- {id: 2, marker: {id: 1, height_m: 0.1}}\n  - {id: 1,", "two robots"),
        (', key: "' + "ab" * 32 + '"', "", "ada has no key"),
    ],
    ids=["no floor markers", "two equal ids", "two equal markers", "no key"],
)
def test_a_bad_arena_is_one_line(
    table: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str
) -> None:
    assert old in ARENA
    bad = table / "bad.yaml"
    bad.write_text(ARENA.replace(old, new) + "world: arena.world.yaml\n", "utf-8")
    command = ["arena", "run", str(table / "floor.png"), str(bad), "--link", "127.0.0.1:0"]
    assert run(command) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert said in line


@pytest.mark.parametrize("camera", ["97", "rtsp://127.0.0.1:9/none", "http://127.0.0.1:9/none"])
def test_a_camera_that_is_not_there_is_one_line(
    table: Path, capsys: pytest.CaptureFixture[str], camera: str
) -> None:
    assert run(["arena", "run", camera, str(table / "arena.yaml"), "--limit", "1"]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert "cannot be opened" in line
