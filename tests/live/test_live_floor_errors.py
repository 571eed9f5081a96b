"""The error map behind the page: measured beside the arena, one at a time, and honest."""

import threading

import numpy as np
import pytest
from live_server import eventually

from tagmetry.arena import ErrorMap, GridPlace
from tagmetry.errors import InputError
from tagmetry.live.messages import FloorErrors, MeasureErrors, Told
from tagmetry.live.rooms import floor_errors as room_module
from tagmetry.live.rooms.floor_errors import floor_errors_room, told_errors
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


def test_measures_one_at_a_time_and_tells_when_it_begins_and_ends(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    go, told, seeds = threading.Event(), list[Told](), list[int]()

    def slow(seed: int) -> ErrorMap:
        seeds.append(seed)
        go.wait(10)
        return found()

    monkeypatch.setattr(room_module, "floor_errors", slow)
    take = floor_errors_room(told.append).takers[MeasureErrors]
    take(MeasureErrors())
    with pytest.raises(InputError, match="being measured already"):
        take(MeasureErrors())
    assert told == [FloorErrors(True, GRID.step_m, GRID.height_m, ())]
    go.set()
    eventually(lambda: len(told) == 2)
    assert told[1] == told_errors(found())
    eventually(lambda: not any(one.name == "floor errors" for one in threading.enumerate()))
    take(MeasureErrors())
    eventually(lambda: len(told) == 4)
    assert seeds == [1, 2]


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
