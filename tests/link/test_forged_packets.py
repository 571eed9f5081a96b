"""Nothing that is forged, mutated, replayed, late or reflected is accepted, and nothing crashes."""

import random
import struct
import subprocess
from pathlib import Path

import pytest
from air import ROBOTS, Air
from attacks import Attacker
from compiled import SOURCES, build

from tagmetry.link import Command, Odometry

TARGETS = ["host", *ROBOTS]
PROGRAM = """
#include <stdio.h>
#include "tagmetry_link.h"
static uint64_t drawn = 1000;
uint64_t tm_random(void) { return ++drawn; }
int main(void) {
    static uint8_t packet[2048];
    uint8_t key[TM_KEY_BYTES], out[TM_MOST_BYTES];
    uint16_t size;
    uint64_t now_us;
    tm_robot robot;
    long accepted = 0, count = 0;
    for (int i = 0; i < TM_KEY_BYTES; i++) key[i] = (uint8_t)i;
    tm_begin(&robot, 3, key);
    for (; fread(&size, 2, 1, stdin) && fread(&now_us, 8, 1, stdin); count++) {
        if (fread(packet, 1, size, stdin) != size) return 1;
        accepted += tm_receive(&robot, packet, size, now_us) != 0;
        tm_due(&robot, out, now_us);
        tm_command(&robot, now_us);
    }
    printf("%ld %ld\\n", count, accepted);
    return 0;
}
"""


def attack(target: str, count: int) -> None:
    air = Air(ROBOTS["python" if target == "host" else target]()).link()
    attacker = Attacker(air, random.Random(5), at_host=target == "host")  # noqa: S311
    accept = air.is_heard if target == "host" else air.to_robot
    for number, packet in enumerate(attacker.packets(count)):
        assert not accept(packet), (number, packet.hex())
    genuine = air.say(Odometry(1, 0, 0, 0)) if target == "host" else air.send(Command(1.0))
    assert accept(genuine)


@pytest.mark.parametrize("target", TARGETS)
def test_nothing_false_is_accepted(target: str) -> None:
    attack(target, 7_000)


@pytest.mark.slow
@pytest.mark.parametrize("target", TARGETS)
def test_nothing_false_is_accepted_of_a_million(target: str) -> None:
    attack(target, 340_000)


@pytest.mark.parametrize("count", [3_000, pytest.param(200_000, marks=pytest.mark.slow)])
def test_the_c_client_reads_no_byte_too_many(tmp_path: Path, count: int) -> None:
    source = tmp_path / "hear.c"
    source.write_text(PROGRAM, "utf-8")
    sanitized = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    built = build(tmp_path / "hear", SOURCES / "tagmetry_link.c", source, flags=sanitized)
    air = Air(ROBOTS["python"]())  # draws the same nonces as the program
    assign = air.to_host(air.robot.due(air.robot_us))[0]
    said = [(air.robot_us, assign)]
    assert air.to_robot(assign)
    air.to_host(air.robot.due(air.robot_us))
    attacker = Attacker(air, random.Random(6), at_host=False)  # noqa: S311
    said += [(air.robot_us, packet) for packet in attacker.packets(count)]
    said += [(air.robot_us, air.send(Command(1.0)))]
    script = b"".join(struct.pack("<HQ", len(packet), us) + packet for us, packet in said)
    ran = subprocess.run([built], input=script, capture_output=True, check=False, timeout=300)
    assert ran.returncode == 0, ran.stderr.decode()
    number, accepted = map(int, ran.stdout.split())
    assert number == count + 2
    assert accepted == 2  # the ASSIGN at the beginning and the command at the end
