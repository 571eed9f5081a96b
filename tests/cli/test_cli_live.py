"""`tagmetry live` on the command line: the video without a browser, and what it refuses."""

import socket
from pathlib import Path

import pytest

from tagmetry.cli.main import run


def test_writes_a_video_and_a_summary(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    av = pytest.importorskip("av", reason="a video needs the part `video`")
    path = tmp_path / "arena.mp4"
    assert run(["live", "--headless", str(path), "--seconds", "0.5", "--robots", "2"]) == 0
    told = capsys.readouterr().out
    assert "images" in told
    assert f"wrote {path}" in told
    with av.open(str(path)) as video:
        assert sum(1 for _ in video.decode(video=0)) == 5


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--scenario", "fly"], "there is no scenario 'fly'"),
        (["--address", "0.0.0.0"], "name the address of one"),  # noqa: S104
        (["--address", "203.0.113.7"], "cannot listen at 203.0.113.7"),
        (["--address", "localhost"], "address of an interface"),
        (["--robots", "0"], "robots"),
    ],
)
def test_refuses_in_one_line(
    arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["live", "--no-browser", "--port", "0", *arguments]) == 2
    out, err = capsys.readouterr()
    assert told in err
    assert err.count("\n") == 1
    assert "token" not in out


def test_a_taken_port_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        assert run(["live", "--no-browser", "--port", str(port)]) == 2
    assert f"port {port}" in capsys.readouterr().err
