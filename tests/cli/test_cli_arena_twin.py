"""`tagmetry arena twin` in a shell."""

import sys

import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from tagmetry.cli.main import run

COME = "from tagmetry.arena.drive import Twist\n"


def said(capsys, *arguments):
    assert run(["arena", "twin", *map(str, arguments)]) == 0
    return capsys.readouterr().out


def test_two_robots_drive_and_are_drawn_and_recorded(tmp_path, capsys):
    picture, recording = tmp_path / "ways.png", tmp_path / "run.mcap"
    text = said(capsys, "--seconds", 2, "--picture", picture, "--record", recording)
    assert text.startswith("2.0 s in ")
    assert "nearest 0." in text
    assert "stability at 50 ms, along: gain x 1.2" in text
    assert picture.read_bytes().startswith(b"\x89PNG")
    from tagmetry.record.mcap import STATES, read_entries

    states = [entry for entry in read_entries(recording) if entry.topic == STATES]
    assert len(states) > 50


def test_with_rendered_pictures(capsys):
    text = said(capsys, "--seconds", 0.3, "--pictures", "--robots", 3)
    assert "places within" in text


def test_a_controller_of_one_s_own(tmp_path, capsys):
    file = tmp_path / "mine.py"
    file.write_text(COME + "def control(view):\n    return Twist(0.1, 0.5)\n")
    text = said(capsys, "--controller", file, "--robots", 3, "--seconds", 2)
    assert "stopped" not in text
    assert 0.3 < float(text.split(" m driven")[0].split(", ")[-1]) < 0.7


def test_one_for_each_robot_and_one_that_raises(tmp_path, capsys):
    file = tmp_path / "mine.py"
    file.write_text(
        COME + "def controller(robot):\n    return lambda view: Twist(0.1 / robot, 0)\n"
    )
    text = said(capsys, "--controller", file, "--robots", 2, "--seconds", 1)
    assert "raised ZeroDivisionError" in text


@pytest.mark.skipif(sys.platform == "win32", reason="robots' processes are for POSIX")
def test_robots_as_processes_drive_the_same_way(tmp_path, capsys):
    file = tmp_path / "mine.py"
    file.write_text(COME + "def control(view): return Twist(0.1, len(view.neighbours))\n")
    driven = ["--controller", file, "--on-board", "--seconds", 1]
    told = [said(capsys, *driven, *more).split(": ", 1)[1] for more in ([], ["--processes"])]
    assert told[0] == told[1]
    assert "nearest" in told[0]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("x = 1\n", "neither a function control(view)"),
        ("1 / 0\n", "raised ZeroDivisionError"),
        ("def controller(robot): return 3\n", "returned int, a function is wanted"),
    ],
)
def test_files_that_are_no_controllers(tmp_path, capsys, content, told):
    file = tmp_path / "mine.py"
    file.write_text(content)
    assert run(["arena", "twin", "--controller", str(file), "--seconds", "0.2"]) == 2
    assert told in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--controller", "dance"], "there is no scenario 'dance'"),
        (["--controller", "missing.py"], "expected a Python file"),
        (["--picture", "ways.jpg"], "the picture is a PNG"),
        (["--record", "run.bag"], "ends in .mcap"),
        (["--on-board"], "--on-board needs a controller's file, leader_follower is a scenario"),
        (["--program", "0=./robot"], "give --processes as well"),
        (["--processes", "--program", "./robot"], "a robot's program like 3=./robot"),
        (["--processes", "--program", "7=./robot"], "there is no robot 7, only 0 to 1"),
        (["--processes", "--program", "0=./no/robot"], "cannot start the robot's program"),
    ],
)
def test_what_it_refuses(capsys, arguments, told):
    assert run(["arena", "twin", "--seconds", "0.1", *arguments]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert len(error.splitlines()) == 1
