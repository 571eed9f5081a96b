"""`tagmetry compare`: two trajectories, as text, as JSON and as a picture."""

import json

import cv2
import pytest

from tagmetry.cli.main import run

WAY = "".join(f"{n} {n} {n % 3} 0.5 0 0 0 1\n" for n in range(6))


@pytest.fixture
def ways(tmp_path):
    """Return a way, the same one 30 mm higher, and the folder."""
    (tmp_path / "true.tum").write_text(WAY)
    (tmp_path / "own.tum").write_text(WAY.replace(" 0.5 ", " 0.53 "))
    return str(tmp_path / "own.tum"), str(tmp_path / "true.tum"), tmp_path


def test_tells_absolute_and_relative_errors(ways, capsys):
    assert run(["compare", *ways[:2], "--gap", "1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "6 poses over 7.893 m"
    assert lines[2].split() == ["absolute_mm", "30.000", "30.000", "30.000", "30.000"]
    assert lines[4].split() == ["relative_mm", "0.000", "0.000", "0.000", "0.000"]


def test_aligned_as_json_with_a_picture(ways, capsys):
    pytest.importorskip("matplotlib")
    picture = ways[2] / "errors.png"
    options = ["--align", "path", "--gap", "1", "--json", "--picture", str(picture)]
    assert run(["compare", *ways[:2], *options]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["poses"] == 6
    assert told["unmatched"] == 0
    assert told["absolute_mm"]["largest"] == pytest.approx(0, abs=1e-6)
    assert cv2.imread(str(picture)).std() > 5


def test_one_common_pose_has_no_relative_error(ways, capsys):
    (ways[2] / "one.tum").write_text(WAY.splitlines()[3])
    assert run(["compare", str(ways[2] / "one.tum"), ways[1], "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["relative_mm"]["rms"] is None


@pytest.mark.parametrize(
    ("options", "why"),
    [
        (["--picture", "a.svg"], "the picture is a PNG"),
        (["--align", "scale"], "'scale' is not one of 'none', 'path', 'rig'"),
        (["--gap", "-1"], "--gap"),
        (["--gap", "1", "--step", "9"], "no two poses are 9 s apart; they are 5 s from the first"),
    ],
)
def test_refuses(ways, options, why, capsys):
    assert run(["compare", *ways[:2], *options]) == 2
    assert why in capsys.readouterr().err
