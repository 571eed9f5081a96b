"""`tagmetry bench` on the smallest cases: tables, files, comparison, refusals, Ctrl-C."""

import os
import signal
import subprocess
import time
from dataclasses import replace
from pathlib import Path

import pytest
from cli_command import arguments_of

from tagmetry.cli.main import run
from tagmetry.lab.bench import Results, Row, load_results, save_results
from tagmetry.lab.bench.machine import this_machine


@pytest.fixture(scope="module")
def measured(small_picture: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of a run on one small picture."""
    out = tmp_path_factory.mktemp("bench") / "out.json"
    arguments = ["--images", str(small_picture), "--engine", "opencv-subpix", "--threads", "1"]
    assert run(["bench", *arguments, "--json", str(out)]) == 0
    return out


def test_measures_ours_and_the_engine_asked_for_on_own_pictures(measured: Path) -> None:
    ours, peer = load_results(measured).rows
    assert (ours.engine, peer.engine) == ("tagmetry", "opencv-subpix")
    assert ours.judged_by == "agreement"
    assert (ours.found, ours.expected, ours.false_positives) == (1, 1, 0)
    assert ours.p50_ms > 0
    assert ours.corner_rms_px < 1


def test_prints_a_table_of_100_columns_and_compares(
    measured: Path, small_picture: Path, capsys: pytest.CaptureFixture, tmp_path: Path
) -> None:
    former = load_results(measured)
    machine = replace(former.machine, processor="abacus")
    save_results(replace(former, machine=machine), tmp_path / "old.json")
    arguments = ["--images", str(small_picture), "--engine", "opencv-subpix", "--threads", "1"]
    assert run(["bench", *arguments, "--compare", str(tmp_path / "old.json")]) == 0
    out = capsys.readouterr().out
    assert all(len(line) <= 100 for line in out.splitlines())
    for wanted in ("1 thread", "own (by agreement)", " opencv-subpix ", "1/1", "former run"):
        assert wanted in out
    assert "other machine: abacus, " in out


def drawn(rows: list[Row], path: Path) -> None:
    pytest.importorskip("matplotlib")
    from tagmetry.lab.bench.picture import save_picture

    save_picture(Results(this_machine(), "tag36h11", tuple(rows)), path)


def test_draws_what_there_is(tmp_path: Path) -> None:
    rows = [
        Row(case, engine, 1, "processor", 2.0, p50_ms=5.0, corner_rms_px=0.01, bound_px=0.009)
        for case in ("count-1", "count-24", "side-30", "film-24", "film-96")
        for engine in ("tagmetry", "tagmetry-track", "former-engine")
    ]
    drawn(rows, tmp_path / "out.png")
    assert (tmp_path / "out.png").read_bytes().startswith(b"\x89PNG")


def test_draws_a_single_case(tmp_path: Path) -> None:
    one = Row("own", "tagmetry", 2, "wall", 2.0, p50_ms=5.0, corner_rms_px=0.01)
    drawn([one], tmp_path / "out.png")
    assert (tmp_path / "out.png").exists()


def test_refuses_to_draw_nothing(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="nothing was found that could be drawn"):
        drawn([Row("count-1", "tagmetry", 1, "processor", 2.0, p50_ms=5.0)], tmp_path / "out.png")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--quick", "--full"], "expected --quick or --full, found both"),
        (["--case", "upside"], "no case is called 'upside'; there are count-24, "),
        (["--engine", "aruco9"], "unknown engine 'aruco9'; there are tagmetry, "),
        (["--family", "tag99"], "unknown marker family"),
        (["--images", "missing-*.png"], "no picture or video matches 'missing-*.png'"),
        (["--images", "a.png", "--case", "none"], "leave out --case and --real"),
        (["--images", "a.png", "--family", "tag99"], "unknown marker family"),
        (["--compare", "missing.json"], "missing.json: No such file"),
        (["--picture", "out.gif"], "the picture is a PNG"),
        (["--threads", "0"], "--threads"),
        (["--json", "missing/out.json"], "there is no folder missing"),
    ],
)
def test_refuses_in_one_line(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture
) -> None:
    assert run(["bench", *arguments]) == 2
    out, err = capsys.readouterr()
    assert said in err
    assert err.count("\n") == 1
    assert out == ""


def test_refuses_real_pictures_that_nobody_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.delenv("TAGMETRY_DATA", raising=False)
    assert run(["bench", "--real"]) == 2
    assert "set TAGMETRY_DATA" in capsys.readouterr().err


def alive_in_group(group: int) -> list[str]:
    """Return what runs in a group of processes; the dead that nobody buried do not."""
    stats = [path.read_text().rpartition(")") for path in Path("/proc").glob("[0-9]*/stat")]
    return [
        name for name, _, rest in stats if rest.split()[2] == str(group) and rest.split()[0] != "Z"
    ]


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="asks Linux who is alive")
def test_ctrl_c_leaves_what_is_finished_and_no_process(tmp_path: Path) -> None:
    out = tmp_path / "out.json"
    cases = ["--case", "size-[47]?0p", "--engine", "opencv-none", "--threads", "1"]
    process = subprocess.Popen(
        arguments_of("bench", *cases, "--json", out),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    while not out.exists():
        time.sleep(0.05)
        assert process.poll() is None
    os.killpg(process.pid, signal.SIGINT)
    said, err = process.communicate(timeout=60)
    assert (process.returncode, said, err) == (130, b"", b"tagmetry: interrupted\n")
    assert {row.case for row in load_results(out).rows} == {"size-480p"}
    assert [path.name for path in tmp_path.iterdir()] == ["out.json"]
    assert alive_in_group(process.pid) == []
