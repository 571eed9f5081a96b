"""`tagmetry arena run --record`, `replay` and `export`: a run again, bit by bit, and as tables."""

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from small_table import CAMERA, T_CAMERA_WORLD, TABLE

from tagmetry.cli.main import run
from tagmetry.files import save_camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.record.mcap import IMAGES, read_entries
from tagmetry.twin import render

pytest.importorskip("mcap", reason="recordings need the part arena")


def shown(number: int, at_m: tuple[float, float, float], size_m: float) -> MountedMarker:
    at = RigidTransform.from_components(at_m, Rotation.from_euler("z", 0.3))
    return MountedMarker("tag36h11", number, size_m, at)


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an arena that is calibrated, and pictures of a robot that moves."""
    folder = tmp_path_factory.mktemp("table")
    save_camera(CAMERA, folder / "ceiling.yaml")
    (folder / "arena.yaml").write_text(TABLE, "utf-8")
    floor = [shown(100, (-0.5, 0.3, 0), 0.1), shown(101, (0.5, 0.3, 0), 0.1)]
    (folder / "drive").mkdir()
    rng = np.random.default_rng(0)
    for n in range(6):
        markers = [*floor, shown(1, (0.01 * n, -0.1, 0.1), 0.08)]
        pixels = render(markers, T_CAMERA_WORLD, CAMERA, rng)
        cv2.imwrite(str(folder / "drive" / f"{n}.png"), pixels)
    floor_picture = str(folder / "drive" / "0.png")
    assert run(["arena", "calibrate", floor_picture, str(folder / "arena.yaml")]) == 0
    return folder


def recorded(table: Path, path: Path, *options: str) -> list[str]:
    """Record a run, and return the lines that it printed."""
    out = path.with_suffix(".jsonl")
    command = ["arena", "run", str(table / "drive"), str(table / "arena.yaml")]
    assert run([*command, "--record", str(path), "--out", str(out), *options]) == 0
    return out.read_text("utf-8").splitlines()


def test_a_lossless_recording_gives_the_same_again(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.mcap"
    lines = recorded(table, path, "--lossless")
    assert len(list(read_entries(path, IMAGES))) == 6
    capsys.readouterr()
    assert run(["arena", "replay", str(path), str(table / "arena.yaml"), "--lines"]) == 0
    said = capsys.readouterr()
    assert "6 images: all markers as recorded" in said.err
    assert [json.loads(line) for line in said.out.splitlines()] == [json.loads(x) for x in lines]


def test_a_jpeg_recording_says_how_far_corners_moved(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.mcap"
    recorded(table, path)
    capsys.readouterr()
    assert run(["arena", "replay", str(path), str(table / "arena.yaml")]) == 0
    said = capsys.readouterr().out
    assert said.startswith("6 images: 0 markers are not in both, corners moved by up to 0.")


def test_a_recording_is_a_source_like_any_other(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.mcap"
    lines = recorded(table, path, "--lossless")
    capsys.readouterr()
    assert run(["arena", "run", str(path), str(table / "arena.yaml")]) == 0
    assert capsys.readouterr().out.splitlines() == lines


def test_tables_and_pictures(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.mcap"
    recorded(table, path)
    capsys.readouterr()
    assert run(["arena", "export", str(path), str(tmp_path / "out"), "--images"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        f"wrote {tmp_path / 'out' / name}: 6 messages"
        for name in ("detections.csv", "states.csv", "images")
    ]
    with (tmp_path / "out" / "states.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    moved_m = float(rows[-1]["x_m"]) - float(rows[0]["x_m"])
    assert np.hypot(moved_m, float(rows[-1]["y_m"]) - float(rows[0]["y_m"])) == pytest.approx(
        0.05, abs=0.002
    )


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["replay", "none.mcap", "arena.yaml"], "none.mcap: No such file"),
        (["replay", "arena.yaml", "arena.yaml"], "expected an MCAP file, found something else"),
        (["export", "none.mcap", "out"], "none.mcap: No such file"),
        (["run", "drive", "arena.yaml", "--record", "run.bag"], "name that ends in .mcap"),
        (["run", "none.mcap", "arena.yaml"], "none.mcap: No such file"),
    ],
)
def test_refusals_are_one_line(
    table: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    reason: str,
) -> None:
    monkeypatch.chdir(table)
    assert run(["arena", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert reason in line


def test_latency_needs_a_live_camera_and_a_robot_that_is_there(
    table: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["arena", "latency", str(table / "drive"), str(table / "arena.yaml"), "--robot"]
    assert run([*command, "9"]) == 2
    assert "there is no robot 9" in capsys.readouterr().err
    assert run([*command, "1"]) == 2
    assert "is no live camera: nothing in it can obey" in capsys.readouterr().err
