"""`tagmetry warmup`: everything is compiled once, kept, and said in a line."""

import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from cli_command import tagmetry

import tagmetry as package
from tagmetry.cli import kernels, warmup
from tagmetry.cli.main import run

SOURCE = Path(package.__file__).parents[1]
TWO_KERNELS = """
from numba import njit

@njit(cache=True)
def twice(x):
    return 2 * x

@njit(cache=True)
def thrice(x):
    return 3 * x
"""
ALL_AND_REACHED = """
import pkgutil
import tagmetry.pipeline.warmup
from tagmetry.cli.kernels import kernels
reached = set(kernels())
for one in pkgutil.walk_packages(tagmetry.__path__, "tagmetry."):
    if one.name.split(".")[1] in ("geometry", "markers", "camera", "detect", "calibrate", "pose",
                                  "localize", "lens", "arena", "twin"):
        __import__(one.name)
print(sorted(set(kernels()) - reached))
"""
COLD_RUN = """
import sys
import tagmetry.pipeline.warmup as warmup
from tagmetry.cli.kernels import kept_count, kernels
for name in warmup.warmed():
    print(name)
some = kernels()
print([name for name, one in some.items() if not one.signatures], kept_count(some) == len(some))
print([one.id for one in warmup.Detector().detect(warmup._picture())])
"""


def started(code: str, folder: Path) -> subprocess.Popen:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder), "PYTHONPATH": str(SOURCE)}
    return subprocess.Popen(
        [sys.executable, "-W", "error", "-c", code],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_it_says_in_one_line_what_is_kept_where(capsys: pytest.CaptureFixture) -> None:
    assert run(["warmup"]) == 0
    assert run(["warmup"]) == 0
    out, err = capsys.readouterr()
    assert out.splitlines()[1].split(" ", 1)[1].startswith("kernels were ready, ")
    assert "; kept in " in out
    assert err == ""


def test_it_reaches_every_kernel_there_is() -> None:
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    ran = subprocess.run(
        [sys.executable, "-c", ALL_AND_REACHED],
        check=True,
        capture_output=True,
        text=True,
        env=environment,
    )
    assert ran.stdout.strip() == "[]"


def test_what_is_not_kept_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = tmp_path / "two_kernels.py"
    source.write_text(TWO_KERNELS, "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    fresh = import_module("two_kernels")
    assert list(kernels.kernels("two_kernels")) == ["two_kernels.twice", "two_kernels.thrice"]
    assert kernels.compile_time_s("two_kernels") == pytest.approx(1.2)
    fresh.twice(1)
    assert kernels.kept_count(kernels.kernels("two_kernels")) == 1
    fresh.thrice(1)
    assert kernels.compile_time_s("two_kernels") == 0.0
    os.utime(source, (2e9, 2e9))
    assert kernels.compile_time_s("two_kernels") == pytest.approx(1.2)
    monkeypatch.delitem(sys.modules, "two_kernels")
    assert kernels.compile_time_s("two_kernels") == 0.0


def test_who_watches_is_told_before_the_first_image(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr(warmup, "compile_time_s", lambda _: 30.2)
    warmup.tell_compiling()
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    warmup.tell_compiling()
    told = "tagmetry: compiling for this machine, once: about 30 s\n"
    assert capsys.readouterr().err == told
    monkeypatch.setattr(warmup, "compile_time_s", lambda _: 0.0)
    warmup.tell_compiling()
    assert capsys.readouterr().err == ""


def test_without_a_folder_that_can_be_written_it_runs_and_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", "")
    monkeypatch.delenv("NUMBA_CACHE_DIR")
    monkeypatch.setattr(kernels, "_can_write", lambda _: False)
    kernels.ensure_cache_folder()
    assert Path(os.environ["NUMBA_CACHE_DIR"]).is_dir()
    assert run(["warmup"]) == 0
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("tagmetry: no folder to keep compiled code in can be written, so every ")
    assert err.count("\n") == 1


def test_a_folder_that_can_be_written_is_left_to_numba(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    kernels.ensure_cache_folder()
    assert "NUMBA_CACHE_DIR" not in os.environ
    assert kernels.is_kept()


@pytest.mark.slow
def test_an_empty_folder_is_filled_by_two_processes_at_once(tmp_path: Path) -> None:
    both = [started(COLD_RUN, tmp_path), started(COLD_RUN, tmp_path)]
    for one in both:
        out, err = one.communicate(timeout=900)
        assert (one.returncode, err) == (0, "")
        assert out.splitlines()[-2:] == ["[] True", "[3]"]
    third = tagmetry("warmup", NUMBA_CACHE_DIR=str(tmp_path))
    assert b"kernels were ready" in third.stdout
    assert str(tmp_path).encode() in third.stdout
