"""An arena in one process, who looks on and who commands in others."""

import signal
import sys
import time
from collections import Counter

import numpy as np
import pytest
from peers import (
    COMMAND_KEY,
    ROBOTS,
    VIEW_KEY,
    arena,
    free_endpoint,
    line_of,
    program,
    robot_state,
    start,
    until,
)

from tagmetry.link import Command, Refusal
from tagmetry.link.computers import ArenaBridge, ArenaSight, ArenaView, Commander
from tagmetry.link.computers.net import Net
from tagmetry.link.computers.topics import is_told

pytest.importorskip("zenoh", reason="needs the part zenoh")

SLOW = """
import sys, time
from peers import VIEW_KEY
from tagmetry.link.computers import ArenaView
with ArenaView(sys.argv[1], "lab", VIEW_KEY) as view:
    print("open", flush=True)
    while view.wait() is None:
        pass
    print("looks", flush=True)
    while True:
        time.sleep(10)
"""


def look(endpoint: str) -> ArenaView:
    return ArenaView(endpoint, "lab", VIEW_KEY)


@pytest.mark.parametrize("seconds", [3, pytest.param(60, marks=pytest.mark.slow)])
def test_nothing_is_lost_of_24_robots_at_120_images_a_second(seconds: int) -> None:
    endpoint, images, ages_s = free_endpoint(), 120 * seconds, []
    came: Counter[str] = Counter()
    seen: list[ArenaSight] = []
    with arena(endpoint, images, begin=False) as running, look(endpoint) as view:
        counter = Net(connect=endpoint)
        inbox = counter.inbox("tagmetry/lab/**", 50_000)
        until(lambda: view.is_heard)
        start(running)
        while came["tagmetry/lab/state"] < images:
            sight = view.wait(3.0)
            came.update(topic for topic, _ in inbox.all(50_000))
            if sight is None:
                break
            seen.append(sight)
            ages_s.append(view.age_s)
        counter.close()
    came = Counter({topic: number for topic, number in came.items() if is_about_images(topic)})
    assert len(came) == 3 * len(ROBOTS) + 1
    assert set(came.values()) == {images}
    late = view.refused.get(Refusal.LATE, 0)  # where the computer gave no turn for 250 ms
    assert sum(one.missing for one in seen) <= late
    last = seen[-1]
    assert len(seen) > images / 10  # however busy the computer is
    assert [one.name for one in last.world] == list(ROBOTS.values())
    expected = [robot_state(number, last.image) for number in ROBOTS]
    assert [(one.x_m, one.y_m) for one in last.world] == [(e.x_m, e.y_m) for e in expected]
    assert last.held == {2}
    assert set(last.neighbours) == set(last.commanded) == set(ROBOTS)
    p50, p99 = 1000 * np.percentile(ages_s, [50, 99])
    print(f"\n{sum(came.values())} packets; {len(seen)} of {images} images were looked at")
    print(f"age when looked at: p50 {p50:.1f} p99 {p99:.1f} ms; {late} late")


def is_about_images(topic: str) -> bool:
    return topic == "tagmetry/lab/state" or is_told(topic)


def test_a_host_that_dies_is_missed_and_its_successor_found() -> None:
    endpoint = free_endpoint()
    with arena(endpoint) as running, look(endpoint) as view:
        until(lambda: view.newest is not None)
        running.kill()
        assert until(lambda: not view.is_heard) < 5
        assert view.age_s > 0.4
        running.wait()
        with arena(endpoint):
            until(lambda: view.is_heard and view.age_s < 0.3)


def test_a_program_that_is_slow_sees_few_images_and_none_late() -> None:
    endpoint = free_endpoint()
    with arena(endpoint), look(endpoint) as view:
        until(lambda: view.newest is not None)
        seen, ages_s = [], []
        for _ in range(5):
            time.sleep(0.4)
            sight = view.wait()
            assert sight is not None
            seen.append(sight.image)
            ages_s.append(view.age_s)
            assert len(view._unread) < 5000
    assert min(np.diff(seen)) > 20
    assert np.median(ages_s) < 0.2


def test_a_program_that_computes_all_the_time_still_sees_images() -> None:
    endpoint = free_endpoint()
    with arena(endpoint), look(endpoint) as view:
        until(lambda: view.newest is not None)
        images = []
        for _ in range(20):
            end_s = time.monotonic() + 0.1
            while time.monotonic() < end_s:
                sum(range(1000))
            sight = view.wait()
            images.append(-1 if sight is None else sight.image)
    assert len({*images} - {-1}) > 10  # a callback for each packet lets 2 through


def test_one_without_the_key_sees_nothing() -> None:
    endpoint = free_endpoint()
    with arena(endpoint), ArenaView(endpoint, "lab") as blind, look(endpoint) as view:
        until(lambda: view.newest is not None)
        until(lambda: Refusal.SESSION in blind.refused)
        assert blind.newest is None
        assert not blind.is_heard


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc, stops a process")
def test_a_reader_that_sleeps_delays_nobody_and_fills_no_memory() -> None:
    endpoint, images = free_endpoint(), 120 * 6
    with arena(endpoint, images, begin=False) as running, program(SLOW, endpoint) as slow:
        assert line_of(slow) == "open"
        start(running)
        assert line_of(slow) == "looks"
        slow.send_signal(signal.SIGSTOP)
        with look(endpoint) as view:
            told = [line_of(running).split() for _ in range(images // 60)]
            assert view.newest is not None
            assert view.newest.missing == 0
    times_ms, kib = np.array(told, dtype=float)[2:, 1:].T
    print(f"\ntelling took at most {times_ms.max():.1f} ms, memory {kib.min()} to {kib.max()} KiB")
    assert np.median(times_ms) < 50
    assert kib[-1] - kib[0] < 16 * 1024


def test_a_commander_drives_stops_and_is_missed() -> None:
    endpoint = free_endpoint()
    keys = {"view_key": VIEW_KEY, "command_key": COMMAND_KEY}
    with ArenaBridge("lab", ROBOTS, listen=endpoint, **keys) as bridge:
        with Commander(endpoint, [3, 4], COMMAND_KEY, "lab") as commander:
            until(lambda: commander.send(3, Command(0.5)) and commander.send(4, Command()))

            def obeys() -> bool:
                commander.send(3, Command(0.5))
                command = bridge.command(3)
                return command is not None and command.forward_mps == 0.5

            until(obeys)
            assert bridge.command(5) is None
            assert all(link.is_linked for link in commander.links())
            commander.stop()
            until(lambda: bridge.is_stopped)
            assert bridge.command(3) == Command()
            commander.release()
            until(lambda: not bridge.is_stopped)
            until(obeys)
        died_s = time.monotonic()
        until(lambda: bridge.command(3) == Command())
        assert time.monotonic() - died_s < 5
        until(lambda: bridge.command(3) is None)


def test_one_with_a_wrong_key_commands_nobody() -> None:
    endpoint = free_endpoint()
    with (
        ArenaBridge("lab", ROBOTS, listen=endpoint, command_key=COMMAND_KEY) as bridge,
        Commander(endpoint, [3], bytes(32), "lab") as wrong,
    ):
        until(lambda: wrong.links()[0].refused.get(Refusal.TAG, 0) > 1)
        assert not wrong.send(3, Command(0.5))
        assert bridge.command(3) is None


def test_nobody_commands_where_no_key_is_given() -> None:
    endpoint = free_endpoint()
    with ArenaBridge("lab", {3: "ada"}, listen=endpoint) as bridge:
        assert not bridge.is_obeying
        with Commander(endpoint, [3], COMMAND_KEY, "lab") as commander:
            time.sleep(0.5)
            assert not commander.send(3, Command(0.5))
        assert bridge.command(3) is None
        assert not bridge.is_stopped
