"""`--help` answers at once: it waits for no library that measures."""

import subprocess
import sys

import pytest
from cli_command import usage_of

from tagmetry.cli.main import run

COMMANDS = [
    "", "detect", "info", "plan", "demo", "camera", "camera show", "camera convert",
    "print", "print marker", "print sheet", "print board", "print board grid",
    "print board aprilgrid", "print board chessboard", "print board charuco",
    "twin", "twin render", "twin list",
    "arena", "arena calibrate", "arena audit", "arena mount", "arena run",
]  # fmt: skip
LIMIT_S = 0.5
HEAVY = ("numpy", "cv2", "scipy", "av", "pyarrow", "reportlab", "yaml", "numba")


def cpu_s(command: str) -> float:
    """Return the processor time of the help, user and system; the least of three runs."""
    runs = [usage_of(*command.split(), "--help") for _ in range(3)]
    assert [usage.code for usage in runs] == [0, 0, 0]
    return min(usage.cpu_s for usage in runs)


@pytest.mark.parametrize("command", ["", "detect", "print marker"])
def test_help_takes_less_than_half_a_second_of_cpu(command: str) -> None:
    assert cpu_s(command) < LIMIT_S


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_every_help_takes_less_than_half_a_second_of_cpu(command: str) -> None:
    assert cpu_s(command) < LIMIT_S


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys; from tagmetry.cli.main import run\n"
        f"codes = [run([*c.split(), '--help']) for c in {COMMANDS!r}]\n"
        f"sys.exit(str([m for m in {HEAVY!r} if m in sys.modules] + [c for c in codes if c]))"
    )
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], check=False, capture_output=True, timeout=60
    )
    assert done.stderr == b"[]\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_help_says_how_to_call_it(command: str, capsys: pytest.CaptureFixture) -> None:
    assert run([*command.split(), "--help"]) == 0
    out, err = capsys.readouterr()
    assert f"Usage: {' '.join(['tagmetry', *command.split()])} " in out
    assert err == ""


def test_the_version_is_told(capsys: pytest.CaptureFixture) -> None:
    from tagmetry import __version__

    assert run(["--version"]) == 0
    assert capsys.readouterr().out == f"tagmetry {__version__}\n"


def test_a_switch_takes_no_value_and_an_argument_stands_in_capitals(
    capsys: pytest.CaptureFixture,
) -> None:
    assert run(["compare", "--help"]) == 0
    out = capsys.readouterr().out
    assert "{ESTIMATED} {TRUE}" in out
    assert "<bool>" not in out
    assert "--json" in out
