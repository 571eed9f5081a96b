"""`tagmetry arena stability` in a shell."""

import json
from pathlib import Path

import pytest

from tagmetry.arena.stability import FollowingSetting, stability
from tagmetry.cli.main import run

ARENA = Path(__file__).resolve().parents[2] / "docs" / "arenas" / "lab.yaml"


def said(capsys, *arguments):
    assert run(["arena", "stability", *map(str, arguments)]) == 0
    return capsys.readouterr().out


def test_it_says_what_the_library_says(capsys):
    told = json.loads(said(capsys, "--delay-ms", 80, "--json"))
    report = stability(FollowingSetting(delay_s=0.08))
    assert told["is_stable"]
    assert told["along"] == pytest.approx(vars(report.along))
    assert told["across"] == pytest.approx(vars(report.across))
    assert told["air_m"] == pytest.approx(report.air_m)
    text = said(capsys, "--delay-ms", 80)
    assert f"{1000 * report.along.delay_s:.0f} ms later than told" in text
    assert f"{1000 * report.air_m:.1f} mm of air left" in text


def test_an_arena_s_robots_and_sensor_count(capsys):
    """Its sensor's ranges have a noise of 5 mm."""
    quiet, noisy = (
        json.loads(said(capsys, *more, "--delay-ms", 80, "--json")) for more in ((), (ARENA,))
    )
    assert noisy["gap_sd_m"] > 10 * quiet["gap_sd_m"]


def test_a_servo_s_integral_costs_margin(capsys):
    told = json.loads(said(capsys, "--delay-ms", 80, "--hold-ms", 200, "--json"))
    report = stability(FollowingSetting(delay_s=0.08, hold_s=0.2))
    assert told["along"] == pytest.approx(vars(report.along))
    assert report.along.gain < stability(FollowingSetting(delay_s=0.08)).along.gain


def test_a_spring_too_stiff_swings_up_and_fast_robots_may_touch(capsys):
    assert "it swings up" in said(capsys, "--delay-ms", 80, "--stiffness", 40)
    unstable = json.loads(said(capsys, "--delay-ms", 80, "--stiffness", 40, "--json"))
    assert unstable["overshoot"] is None
    assert not unstable["is_stable"]
    assert "the bodies may touch" in said(capsys, "--delay-ms", 80, "--length-mm", 165)


def test_the_curves_are_drawn(tmp_path, capsys):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "stability.png"
    said(capsys, "--delay-ms", 80, "--picture", picture)
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "Missing option '--delay-ms'"),
        (["--delay-ms", "80", "--picture", "curve.jpg"], "the picture is a PNG"),
        (["--delay-ms", "80", "--length-mm", "150"], "touch at a distance of 0.15 m"),
        (["--delay-ms", "80", "--speed", "0"], "speed_mps must be 0.001 to 10"),
        (["missing.yaml", "--delay-ms", "80"], "missing.yaml"),
    ],
)
def test_what_it_refuses(capsys, arguments, told):
    assert run(["arena", "stability", *arguments]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert len(error.splitlines()) == 1
