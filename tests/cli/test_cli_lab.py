"""`tagmetry lab` in a shell: what it names, what it refuses, in one line each."""

from pathlib import Path

import pytest
from cli_command import tagmetry

pytest.importorskip("pyarrow")


def line(*arguments: object) -> str:
    """Run what must be refused, and return why."""
    ran = tagmetry("lab", *arguments)
    told = ran.stderr.decode()
    assert (ran.returncode, ran.stdout, told.count("\n")) == (2, b"", 1)
    return told


def test_it_names_the_experiments() -> None:
    ran = tagmetry("lab", "list")
    assert ran.returncode == 0
    assert "seed003-pose: How exact" in ran.stdout.decode()


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (("run",), "name the experiments to run, or give --all; there are seed00"),
        (("run", "seed003-pose", "--all"), "name the experiments to run, or give --all"),
        (("run", "seed9"), "there is no experiment 'seed9'; there are"),
        (("run", "seed003-pose", "--cluster", "nowhere", "--jobs", 2), "--jobs is for"),
    ],
)
def test_what_cannot_be_run(arguments: tuple[object, ...], why: str, tmp_path: Path) -> None:
    assert why in line(*arguments, "--out", tmp_path)


def test_a_report_of_nothing(tmp_path: Path) -> None:
    assert "has no results; `tagmetry lab run` makes them" in line("report", "--out", tmp_path)
    (tmp_path / "seed003-pose.parquet").write_bytes(b"PAR1")
    assert "no whole result of the laboratory" in line("report", "--out", tmp_path)
