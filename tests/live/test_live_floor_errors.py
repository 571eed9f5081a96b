"""The error map behind the page: measured beside the arena, one at a time, and honest."""

import subprocess
import sys
import time

import numpy as np
import pytest
from live_server import eventually

from tagmetry.arena import ErrorMap, GridPlace
from tagmetry.errors import InputError
from tagmetry.live.client.reading import parse_told
from tagmetry.live.messages import FloorErrors, MeasureErrors, Told
from tagmetry.live.messages.wire import format_message
from tagmetry.live.rooms import floor_errors as room_module
from tagmetry.live.rooms.floor_errors import floor_errors_room, started, told_errors
from tagmetry.pipeline.arena_twin.ready.floor_errors import GRID, floor_errors


def found(off_m: float = 1e-3) -> ErrorMap:
    """Return a map of two places, one of which is off."""
    true = np.array([[0.0, 0.0], [0.1, 0.0]])
    measured = np.array([[0.0, 0.0], [0.1, off_m]])
    return ErrorMap(
        np.arange(2), true, measured, np.array([1e-4, 2e-4]), np.zeros(2), GridPlace(), ()
    )


def test_tells_places_errors_and_deviations() -> None:
    told = told_errors(found())
    assert not told.is_measuring
    np.testing.assert_allclose(told.errors, [(0, 0, 0, 0, 1e-4), (0.1, 0, 0, 1e-3, 2e-4)])


def program(says: str, seconds: float = 0.0) -> "subprocess.Popen[str]":
    """Return a program that says something after a while."""
    lines = f"import sys, time; time.sleep({seconds}); sys.stdout.write({says!r})"
    return subprocess.Popen([sys.executable, "-c", lines], stdout=subprocess.PIPE, text=True)


def test_measures_one_at_a_time_and_tells_when_it_begins_and_ends(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told, seeds = list[Told](), list[int]()

    def started(seed: int) -> "subprocess.Popen[str]":
        seeds.append(seed)
        return program(format_message(told_errors(found())), 1.0)

    monkeypatch.setattr(room_module, "started", started)
    room = floor_errors_room(told.append)
    room.takers[MeasureErrors](MeasureErrors())
    with pytest.raises(InputError, match="being measured already"):
        room.takers[MeasureErrors](MeasureErrors())
    assert told == [FloorErrors(True, GRID.step_m, GRID.height_m, ())]
    eventually(lambda: len(told) == 2, 20)
    assert told[1] == told_errors(found())
    time.sleep(0.1)
    room.takers[MeasureErrors](MeasureErrors())
    room.close()
    assert seeds == [1, 2]
    assert told[-1] == FloorErrors(False, GRID.step_m, GRID.height_m, ())


@pytest.mark.parametrize("says", ["", "no message", '{"type": "Refused", "why": "x"}'])
def test_a_program_that_fails_leaves_no_map(monkeypatch: pytest.MonkeyPatch, says: str) -> None:
    told = list[Told]()
    monkeypatch.setattr(room_module, "started", lambda _: program(says))
    floor_errors_room(told.append).takers[MeasureErrors](MeasureErrors())
    eventually(lambda: len(told) == 2, 20)
    assert told[1] == FloorErrors(False, GRID.step_m, GRID.height_m, ())


@pytest.mark.slow
def test_the_program_says_the_map() -> None:
    said, _ = started(0).communicate(timeout=300)
    assert parse_told(said) == told_errors(floor_errors(0))


@pytest.mark.slow
def test_the_stage_is_as_accurate_as_it_says() -> None:
    """Errors of one map share the camera's place, so that only their size can be checked."""
    maps = [floor_errors(seed) for seed in range(4)]
    for one in maps:
        assert len(one.ids) == GRID.count
        assert one.worst_m < 4e-4
        assert one.below_camera_m(0.15) < 1e-4
    squares = np.mean([(one.radial_m / one.sd_m) ** 2 for one in maps])
    assert 0.2 < squares < 3.0
