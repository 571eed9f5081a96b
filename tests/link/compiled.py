"""The C client, compiled with every warning an error, and called in this process."""

import ctypes
import shutil
import subprocess
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import pytest

import tagmetry.link.client
from tagmetry.link.bodies import pack_body, unpack_body
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Command, Message, Neighbours
from tagmetry.link.wire import MOST_BYTES

SOURCES = Path(tagmetry.link.client.__file__).parent
WARNINGS = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]
SHIM = """
#include <stdlib.h>
#include "tagmetry_link.h"
static uint64_t state;
uint64_t tm_random(void) { return state = state * 6364136223846793005u + 1442695040888963407u; }
tm_robot *make(uint16_t id, const uint8_t *key, uint64_t seed);
tm_robot *make(uint16_t id, const uint8_t *key, uint64_t seed) {
    tm_robot *robot = malloc(sizeof *robot);
    state = seed;
    tm_begin(robot, id, key);
    return robot;
}
void command_of(const tm_robot *robot, uint64_t now_us, tm_command_body *out);
void command_of(const tm_robot *robot, uint64_t now_us, tm_command_body *out) {
    *out = tm_command(robot, now_us);
}
int neighbours_of(const tm_robot *robot, const void **list, const void **items);
int neighbours_of(const tm_robot *robot, const void **list, const void **items) {
    *list = &robot->neighbours;
    *items = robot->seen;
    return robot->neighbours.count;
}
int is_stopped(const tm_robot *robot);
int is_stopped(const tm_robot *robot) { return robot->is_stopped; }
int is_linked(const tm_robot *robot);
int is_linked(const tm_robot *robot) { return robot->is_linked; }
"""


def build(target: Path, *sources: Path, flags: tuple[str, ...] = ()) -> Path:
    """Compile; a warning is a failure."""
    if shutil.which("gcc") is None:
        pytest.skip("the C client is compiled with gcc")
    command = ["gcc", "-O2", *WARNINGS, *flags, f"-I{SOURCES}", *sources, "-lm", "-o", target]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert ran.returncode == 0, ran.stderr
    return target


@cache
def library() -> ctypes.CDLL:
    folder = Path(mkdtemp(prefix="tagmetry-link-"))
    shim = folder / "shim.c"
    shim.write_text(SHIM, "utf-8")
    built = build(folder / "link.so", SOURCES / "tagmetry_link.c", shim, flags=("-shared", "-fPIC"))
    loaded = ctypes.CDLL(str(built))
    loaded.make.restype = ctypes.c_void_p
    loaded.make.argtypes = [ctypes.c_uint16, ctypes.c_char_p, ctypes.c_uint64]
    us, robot, out = ctypes.c_uint64, ctypes.c_void_p, ctypes.c_char_p
    loaded.tm_receive.argtypes = [robot, out, ctypes.c_int, us]
    loaded.tm_due.argtypes = [robot, out, us]
    loaded.tm_seal.argtypes = [robot, ctypes.c_int, ctypes.c_char_p, ctypes.c_int, out, us]
    loaded.tm_may_move.argtypes = [robot, us]
    loaded.tm_host_us.argtypes, loaded.tm_host_us.restype = [robot, us], ctypes.c_uint64
    loaded.command_of.argtypes = [robot, us, out]
    return loaded


class CompiledRobot:
    """The C client with the manners of `tagmetry.link.client.Robot`."""

    def __init__(self, robot_id: int, key: bytes, seed: int) -> None:
        self._robot = library().make(robot_id, key, seed)
        self._out = ctypes.create_string_buffer(MOST_BYTES)

    def receive(self, packet: bytes, now_us: int) -> Kind | None:
        number = library().tm_receive(self._robot, packet, len(packet), now_us)
        return Kind(number) if number else None

    def due(self, now_us: int) -> bytes | None:
        return self._written(library().tm_due(self._robot, self._out, now_us))

    def seal(self, message: Message, now_us: int) -> bytes | None:
        kind, body = pack_body(message)
        size = library().tm_seal(self._robot, kind, body, len(body), self._out, now_us)
        return self._written(size)

    def may_move(self, now_us: int) -> bool:
        return bool(library().tm_may_move(self._robot, now_us))

    def host_us(self, now_us: int) -> int:
        return int(library().tm_host_us(self._robot, now_us))

    def command(self, now_us: int) -> Command:
        body = ctypes.create_string_buffer(16)
        library().command_of(self._robot, now_us, body)
        found = unpack_body(Kind.COMMAND, body.raw)
        assert isinstance(found, Command)
        return found

    @property
    def neighbours(self) -> Neighbours | None:
        head, items = ctypes.c_void_p(), ctypes.c_void_p()
        robot = ctypes.c_void_p(self._robot)
        count = library().neighbours_of(robot, ctypes.byref(head), ctypes.byref(items))
        body = ctypes.string_at(head, 12) + ctypes.string_at(items, 10 * count)
        found = unpack_body(Kind.NEIGHBOURS, body)
        assert isinstance(found, Neighbours)
        return found

    @property
    def is_stopped(self) -> bool:
        return bool(library().is_stopped(ctypes.c_void_p(self._robot)))

    def is_linked(self) -> bool:
        return bool(library().is_linked(ctypes.c_void_p(self._robot)))

    def _written(self, size: int) -> bytes | None:
        return self._out.raw[:size] if size else None
