"""Health in words: each thing that is wrong has its line, and nothing is said where all is well."""

from dataclasses import replace
from pathlib import Path

import pytest
from live_server import eventually

from tagmetry.live.health.advice import Signs, advice
from tagmetry.live.health.memory import resident_bytes
from tagmetry.live.messages import Health, StartRecording
from tagmetry.live.show.programme import Programme
from tagmetry.live.show.runner import LiveRunner

WELL = Signs(
    late_s=0.01, image_rate_hz=30.0, wanted_rate_hz=30.0, picture_age_s=0.1,
    losses={"one": 0.01, "two": 0.0}, batteries_v={"one": 8.0, "two": 7.4}, missing=(),
    is_recording=True, dropped_count=0, disk_free_bytes=10**11, failure="",
)  # fmt: skip


def test_nothing_is_said_where_all_is_well() -> None:
    assert advice(WELL) == ()
    unknown = replace(WELL, picture_age_s=None, batteries_v={}, losses={}, disk_free_bytes=None)
    assert advice(unknown) == ()


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"late_s": 0.25}, "too slow: the arena is 0.25 s behind"),
        ({"image_rate_hz": 0.0}, "the camera is gone"),
        ({"image_rate_hz": 12.0}, "Only 12 of 30 images"),
        ({"picture_age_s": 7.0}, "newest picture is 7 s old"),
        ({"losses": {"one": 0.2}}, "one loses 20 % of its packets"),
        ({"batteries_v": {"two": 6.5}}, "two's battery is low: 6.50 V"),
        ({"missing": ("three", "four")}, "Never seen yet: three, four"),
        ({"failure": "disk full"}, "The recording ended: disk full"),
        ({"dropped_count": 4}, "4 messages were not recorded"),
        ({"disk_free_bytes": 3 * 10**8}, "300 MB left"),
    ],
)
def test_each_thing_that_is_wrong_has_its_line(wrong: dict[str, object], told: str) -> None:
    (line,) = advice(replace(WELL, **wrong))
    assert told in line


def test_what_was_dropped_before_is_no_matter_when_nothing_is_recorded() -> None:
    assert advice(replace(WELL, dropped_count=4, is_recording=False)) == ()


def test_memory_is_what_is_held() -> None:
    before = resident_bytes()
    if before is None:
        pytest.skip("this system does not say")
    held = bytearray(80_000_000)
    held[::4096] = b"x" * len(held[::4096])
    after = resident_bytes()
    assert after is not None
    assert after - before > 60_000_000


def test_a_running_arena_tells_its_health(tmp_path: Path) -> None:
    told: list[Health] = []

    def take(message: object) -> None:
        if isinstance(message, Health):
            told.append(message)

    programme = Programme("aggregate", 2, tmp_path / "not yet there", pictures=False)
    with LiveRunner(programme, take) as runner:
        runner.ask(1, StartRecording())
        eventually(lambda: told and told[-1].image_rate_hz > 3 and told[-1].recording, 30)
        eventually(lambda: told[-1].least_battery_v is not None, 30)
    newest = told[-1]
    assert 7.0 < (newest.least_battery_v or 0) <= 8.2
    assert 0 <= newest.worst_loss < 0.2
    assert (newest.disk_free_bytes or 0) > 0
    mean_s = {one.name: one.mean_s for one in newest.stages}
    steps = {
        "to follow the robots",
        "to tell robots what they may know",
        "to decide and to ask controllers",
    }
    assert set(mean_s) == {*steps, "to tell pages"}
    assert 0 < sum(mean_s[name] for name in steps) < newest.turn_s
    assert 0 < mean_s["to tell pages"] < newest.turn_s + 1
