"""Many robots at once, each a process of its own in C: nothing is lost, and little is late."""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from compiled import SOURCES, build

from tagmetry.link import Host, Odometry, Received, now_us
from tagmetry.link.neighbour_table import pack_neighbour_table
from tagmetry.pipeline.steady import steady

RATE_HZ = 50
PROGRAM = """
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "tagmetry_posix.h"
int main(int count, char **words) {
    int id = atoi(words[count - 2]), port = atoi(words[count - 1]);
    int host = tm_connect("127.0.0.1", (uint16_t)port);
    uint8_t key[TM_KEY_BYTES];
    uint64_t heard_us = 0, next_us = 0;
    tm_robot robot;
    memset(key, 7, sizeof key);
    memcpy(key, &id, sizeof id);
    tm_begin(&robot, (uint16_t)id, key);
    for (;;) {
        int64_t rest_us = next_us ? (int64_t)(next_us - tm_now_us()) : 20000;
        tm_step(&robot, host, rest_us > 1000 ? (int)(rest_us / 1000) : 0);
        if (id == 0 && robot.neighbours.captured_us != heard_us) {
            heard_us = robot.neighbours.captured_us;
            printf("%lld\\n", (long long)(tm_now_us() - heard_us));
            fflush(stdout);
        }
        if (!robot.is_linked) next_us = 0;
        if (!robot.is_linked || tm_now_us() < next_us) continue;
        next_us = tm_now_us() > next_us + 20000 ? tm_now_us() + 20000 : next_us + 20000;
        tm_odometry wheels = {0};
        wheels.measured_us = tm_now_us(); /* the clock of this computer, the host's too */
        tm_send(&robot, host, TM_ODOMETRY, &wheels, sizeof wheels);
    }
}
"""


def key_of(robot_id: int) -> bytes:
    return robot_id.to_bytes(4, "little") + bytes([7] * 28)


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's stamps are Linux's")
@pytest.mark.parametrize(
    ("count", "duration_s"),
    [(4, 0.5), pytest.param(100, 10.0, marks=pytest.mark.slow)],
    ids=["few", "hundred"],
)
def test_no_packet_of_many_robots_is_lost(count: int, duration_s: float, tmp_path: Path) -> None:
    source = tmp_path / "robot.c"
    source.write_text(PROGRAM, "utf-8")
    sources = [SOURCES / "tagmetry_link.c", SOURCES / "tagmetry_posix.c", source]
    built = build(tmp_path / "robot", *sources)
    is_quiet = os.getloadavg()[0] < 0.3
    with steady(), Host({n: key_of(n) for n in range(count)}, port=0) as host:
        robots = [start(built, n, host.address[1], tmp_path) for n in range(count)]
        try:
            wait_until_linked(host)
            host.take()
            began_s = time.process_time()
            taken = told(host, count, duration_s)
            busy = (time.process_time() - began_s) / duration_s
            links = host.links()
        finally:
            for robot in robots:
                robot.kill()
                robot.wait()
    sent = [one for one in taken if isinstance(one.message, Odometry)]
    late_ms = {
        "sent to heard": [(one.received_us - one.message.measured_us) / 1000 for one in sent],
        "told to known on a robot": np.loadtxt(tmp_path / "0.txt") / 1000,
        "there and back": [1000 * link.round_trip_s for link in links if link.round_trip_s],
    }
    print(f"{count} robots, {len(sent) / duration_s:.0f} packets/s, {100 * busy:.0f} % of a core")
    for name, values in late_ms.items():
        p50, p99 = np.percentile(values, [50, 99])
        print(f"  {name}: p50 {p50:.2f} p99 {p99:.2f} ms")
    print(f"  lost to robots: {max(link.loss_to_robot for link in links):.4f}")
    assert max(link.loss_from_robot for link in links) == 0.0
    assert all(not link.refused for link in links)
    assert len(sent) > 0.7 * count * RATE_HZ * duration_s
    assert np.percentile(late_ms["sent to heard"], 50) < 50
    if is_quiet:
        assert np.percentile(late_ms["sent to heard"], 99) < 5


def wait_until_linked(host: Host) -> None:
    end_s = time.monotonic() + 30
    while not all(link.is_linked and link.round_trip_s for link in host.links()):
        assert time.monotonic() < end_s, "not all robots were linked"
        time.sleep(0.05)
    time.sleep(0.2)


def start(built: Path, robot_id: int, port: int, folder: Path) -> subprocess.Popen[bytes]:
    with (folder / f"{robot_id}.txt").open("wb") as out:
        return subprocess.Popen([built, str(robot_id), str(port)], stdout=out)


def told(host: Host, count: int, duration_s: float) -> list[Received]:
    """Tell every robot its neighbours 50 times a second, and return what was received."""
    taken: list[Received] = []
    nearest = [(n, 0.1 + n / 100, 1.0, -1.0, 0.0) for n in range(min(count, 24))]
    next_s = end_s = time.monotonic()
    end_s += duration_s
    while next_s < end_s:
        packed = pack_neighbour_table(now_us(), [0.5] * count, [np.array(nearest)] * count)
        assert host.send_all(list(enumerate(packed))) == count
        taken += host.take()
        next_s += 1 / RATE_HZ
        time.sleep(max(next_s - time.monotonic(), 0.0))
    return taken
