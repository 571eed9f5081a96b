"""How a run ends before its input does: by Ctrl-C, or by a reader that goes away."""

import json
import os
import pty
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from cli_command import arguments_of

from tagmetry.cli.main import run
from tagmetry.record import read_results

COUNT = 5000  # pictures, more than any machine reads meanwhile


@pytest.fixture
def many(small_picture: Path, tmp_path: Path) -> str:
    """A folder with many pictures."""
    folder = tmp_path / "many"
    folder.mkdir()
    for number in range(COUNT):
        (folder / f"{number:04}.png").hardlink_to(small_picture)
    return str(folder)


LENIENT = ["-W", "ignore::ResourceWarning"]  # of a file whose opening was interrupted


def interrupted(arguments: list[str]) -> tuple[int, list[bytes], bytes]:
    """Send Ctrl-C after the third line; return exit code, all lines and standard error."""
    python, *rest = arguments_of(*arguments)
    process = subprocess.Popen(
        [python, *rest[:2], *LENIENT, *rest[2:]], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    first = [process.stdout.readline() for _ in range(3)]
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    return process.returncode, [*first, *out.splitlines(keepends=True)], err


@pytest.mark.parametrize("suffix", [".jsonl", ".parquet", ".csv"])
def test_ctrl_c_keeps_what_was_recorded(suffix: str, many: str, tmp_path: Path) -> None:
    out = tmp_path / f"out{suffix}"
    code, lines, err = interrupted(["detect", many, "--json", "--out", str(out)])
    assert (code, err) == (130, b"tagmetry: interrupted\n")
    assert 3 <= len(lines) < COUNT
    assert all(line.endswith(b"\n") for line in lines)
    sequences = [json.loads(line)["sequence"] for line in lines]
    assert sequences == list(range(len(lines)))
    if suffix == ".csv":
        count = len(out.read_text().splitlines()) - 1  # one marker in each picture
    else:
        count = len(list(read_results(out)))
    assert count - len(lines) in (0, 1)  # the last one may be written and not yet told
    assert sorted(path.name for path in tmp_path.iterdir()) == ["many", out.name]


def test_ctrl_c_within_a_compiled_loop_is_one_line_too(
    small_picture: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    """A loop that Numba compiled wraps whatever a signal raised meanwhile."""

    def interrupt(*_: object) -> None:
        inner = SystemError("returned a result with an exception set")
        inner.__cause__ = KeyboardInterrupt()
        raise SystemError("returned a result with an exception set") from inner

    monkeypatch.setattr("tagmetry.cli.report.result_lines", interrupt)
    assert run(["detect", str(small_picture)]) == 130
    assert capsys.readouterr().err == "tagmetry: interrupted\n"


def test_another_fault_of_a_compiled_loop_is_shown_as_it_is(
    small_picture: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise SystemError("a fault of the program")

    monkeypatch.setattr("tagmetry.cli.report.result_lines", fail)
    with pytest.raises(SystemError, match="a fault of the program"):
        run(["detect", str(small_picture)])


def test_ctrl_c_leaves_a_whole_video(many: str, tmp_path: Path) -> None:
    import cv2

    out = tmp_path / "out.mp4"
    code, lines, err = interrupted(["detect", many, "--json", "--overlay", str(out)])
    assert (code, err) == (130, b"tagmetry: interrupted\n")
    count = cv2.VideoCapture(str(out)).get(cv2.CAP_PROP_FRAME_COUNT)
    assert abs(count - len(lines)) <= 1


@pytest.mark.parametrize("options", [["--json"], [], ["--out=-"]])
def test_a_reader_that_goes_away_is_no_error(options: list[str], many: str) -> None:
    process = subprocess.Popen(
        arguments_of("detect", many, *options), stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout.readline().endswith(b"\n")
    process.stdout.close()
    assert process.stderr.read() == b""
    process.stderr.close()
    assert process.wait(timeout=60) == 0


@pytest.mark.parametrize("command", [["info"], ["--help"], ["info", "--json"]])
def test_a_reader_that_never_read_is_no_error(command: list[str]) -> None:
    read_end, write_end = os.pipe()
    os.close(read_end)
    process = subprocess.Popen(arguments_of(*command), stdout=write_end, stderr=subprocess.PIPE)
    os.close(write_end)
    _, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (0, b"")


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
def test_a_progress_bar_leaves_the_results_alone(small_picture: Path) -> None:
    """A person watches standard error while the results go into a file."""
    watcher, terminal = pty.openpty()
    pictures = [small_picture.parent / f"copy{number}.png" for number in range(3)]
    for path in pictures:
        path.write_bytes(small_picture.read_bytes())
    pattern = small_picture.parent / "copy*.png"
    process = subprocess.Popen(
        arguments_of("detect", pattern, "--json"),
        stdout=subprocess.PIPE,
        stderr=terminal,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "250"},
    )
    os.close(terminal)
    out, _ = process.communicate(timeout=60)
    shown = os.read(watcher, 10_000)
    os.close(watcher)
    for path in pictures:
        path.unlink()
    assert process.returncode == 0
    assert [json.loads(line)["sequence"] for line in out.splitlines()] == [0, 1, 2]
    assert b"copy*.png" in shown
    assert b"%" in shown
