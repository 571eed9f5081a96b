"""A child process answers, or says why not, and is gone afterwards."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import fake_engines
import numpy as np
import pytest
from fake_engines import SQUARE_PX, kind

from tagmetry.lab.engines import Answer, Child, Failure, Patience

LIGHT = np.full((40, 40), 200, np.uint8)
NIGHT = np.zeros((40, 40), np.uint8)


USUAL = Patience(20.0, 20.0)


def child(fake: type, threads: int = 1, patience: Patience = USUAL) -> Child:
    return Child(kind(fake), "tag36h11", threads, patience)


def test_answers_what_the_engine_finds_in_each_image() -> None:
    with child(fake_engines.Good) as one:
        assert one.show([LIGHT, NIGHT]) is None
        answers = [one.look(0), one.look(1), one.look(0)]
    assert all(isinstance(answer, Answer) for answer in answers)
    for answer, moved_px in zip(answers, (20.0, 0.0, 20.0), strict=True):
        assert answer.found.ids.tolist() == [7]
        np.testing.assert_allclose(answer.found.corners_px[0], SQUARE_PX + moved_px)


def test_times_are_those_of_the_engine_alone() -> None:
    with child(fake_engines.Good) as quick, child(fake_engines.Slow) as slow:
        for one in (quick, slow):
            one.show([LIGHT])
            one.look(0)
        quick_s, slow_s = (min(o.look(0).cpu_s for _ in range(5)) for o in (quick, slow))
    assert 0 < quick_s < 0.5 * slow_s


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells the peak")
def test_memory_is_what_the_engine_took() -> None:
    with child(fake_engines.Good) as plain, child(fake_engines.Hungry) as hungry:
        for one in (plain, hungry):
            one.show([LIGHT])
        plain_mib, hungry_mib = plain.look(0).memory_mib, hungry.look(0).memory_mib
    assert plain_mib < 10  # what was there before does not count
    assert 45 < hungry_mib - plain_mib < 60


def test_the_engine_and_its_libraries_are_told_how_many_threads() -> None:
    before = dict(os.environ)
    with child(fake_engines.ShowsThreads, threads=3) as one:
        one.show([LIGHT])
        answer = one.look(0)
    assert answer.found.ids.tolist() == [3, 3]
    assert dict(os.environ) == before


def test_a_crash_is_an_answer() -> None:
    with child(fake_engines.DiesOnDark) as one:
        one.show([LIGHT, NIGHT])
        assert isinstance(one.look(0), Answer)
        failure = one.look(1)
        assert isinstance(failure, Failure)
        assert failure.reason.startswith("crashed (SIGABRT)")
        assert one.is_dead
        assert one.look(0) == failure
        assert one.show([LIGHT]) == failure


def test_an_exception_is_a_crash_with_its_text() -> None:
    with child(fake_engines.RaisesOnDark) as one:
        one.show([NIGHT])
        assert one.look(0) == Failure("crashed (exit code 1): RuntimeError: too dark to see")


def test_an_engine_that_cannot_be_made_says_so() -> None:
    with child(fake_engines.NeverMade) as one:
        assert one.show([LIGHT]) == Failure("crashed (exit code 1): ImportError: no such library")


def test_a_silent_engine_is_ended() -> None:
    start_s = time.monotonic()
    with child(fake_engines.HangsOnDark, patience=Patience(0.3)) as one:
        one.show([LIGHT, NIGHT])
        one.look(0)
        assert one.look(1) == Failure("no answer in 0.3 s")
    assert time.monotonic() - start_s < 15


def test_the_first_image_has_a_patience_of_its_own() -> None:
    with child(fake_engines.WarmsUp, patience=Patience(0.3, 20.0)) as one:
        one.show([LIGHT])
        assert isinstance(one.look(0), Answer)
        assert isinstance(one.look(0), Answer)


def test_what_an_engine_writes_goes_nowhere(capfd: pytest.CaptureFixture[str]) -> None:
    with child(fake_engines.Chatty) as one:
        one.show([LIGHT])
        assert isinstance(one.look(0), Answer)
    assert capfd.readouterr() == ("", "")


def test_nothing_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with child(fake_engines.Good) as one:
        one.show([LIGHT])
        process = one._process.pid
        assert list(tmp_path.iterdir())
    assert not list(tmp_path.iterdir())
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


ENDLESS = """
import fake_engines, numpy as np
from tagmetry.lab.engines import Child, Patience
if __name__ == "__main__":
    with Child(fake_engines.kind(fake_engines.HangsOnDark), "tag36h11", 1, Patience(60.0)) as one:
        one.show([np.zeros((9, 9), np.uint8)])
        print(one._process.pid, flush=True)
        one.look(0)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_interrupting_ends_the_child_and_it_says_nothing(tmp_path: Path) -> None:
    script = tmp_path / "endless.py"
    script.write_text(ENDLESS, encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    parent = subprocess.Popen(
        [sys.executable, str(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        text=True,
        start_new_session=True,
    )
    process = int(parent.stdout.readline())
    os.killpg(parent.pid, signal.SIGINT)  # as a terminal does: to the child as well
    _, said = parent.communicate(timeout=30)
    assert said.count("Traceback") == 1  # the parent's own
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)
