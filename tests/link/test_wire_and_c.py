"""The C header says what the Python table says, and the C functions what RFC 7693 says."""

import ctypes
import hashlib
import subprocess
from pathlib import Path

import pytest
from compiled import SOURCES, build, library

from tagmetry.link import wire
from tagmetry.link.layout import Kind, Layout

LAYOUTS = [wire.HEADER, wire.NEIGHBOUR, wire.READING]
LAYOUTS += [body.layout for body in wire.BODIES.values() if body.layout.fields]
STRUCTS = {"command": "tm_command_body"}  # tm_command is a function
CONSTANTS = [
    *("MAGIC", "VERSION", "PORT", "TAG_BYTES", "KEY_BYTES", "MOST_BYTES", "MOST_NEIGHBOURS"),
    *("MOST_READINGS", "SILENCE_US", "LATE_US", "HELLO_US", "RELINK_US", "TIME_US"),
    "LONGEST_COMMAND_MS",
]


def struct_of(layout: Layout) -> str:
    return STRUCTS.get(layout.name, f"tm_{layout.name}")


def question() -> str:
    """Return a C program that prints every size, place, type and constant."""
    lines = ["#include <stddef.h>", "#include <stdio.h>", '#include "tagmetry_link.h"']
    lines += ['#define SIZE(s) printf(#s " %zu\\n", sizeof(s))']
    lines += [
        "#define KIND(s, f) _Generic(((s *)0)->f, uint8_t: 'B', int16_t: 'h', uint16_t: 'H', \\"
    ]
    lines += ["    uint32_t: 'I', uint64_t: 'Q', float: 'f', float *: 'F', char *: 's')"]
    lines += ['#define PLACE(s, f) printf(#s "." #f " %zu %c\\n", offsetof(s, f), KIND(s, f))']
    lines += ["int main(void) {"]
    for layout in LAYOUTS:
        name = struct_of(layout)
        lines += [f"SIZE({name});", *(f"PLACE({name}, {field.name});" for field in layout.fields)]
    lines += [f'printf("{name} %ld\\n", (long)TM_{name});' for name in CONSTANTS]
    lines += [f'printf("{kind.name} %ld\\n", (long)TM_{kind.name});' for kind in Kind]
    return "\n".join([*lines, "return 0;", "}", ""])


def answer() -> list[str]:
    """Return what the table says it must print."""
    lines = []
    for layout in LAYOUTS:
        name, offsets = struct_of(layout), layout.offsets_bytes()
        lines.append(f"{name} {layout.size_bytes}")
        for field in layout.fields:
            letter = wire_letter(field.c_type)
            lines.append(f"{name}.{field.name} {offsets[field.name]} {letter}")
    lines += [f"{name} {getattr(wire, name)}" for name in CONSTANTS]
    return lines + [f"{kind.name} {int(kind)}" for kind in Kind]


def wire_letter(c_type: str) -> str:
    letters = {"uint8_t": "B", "int16_t": "h", "uint16_t": "H", "uint32_t": "I", "uint64_t": "Q"}
    letters |= {"float": "f", "float[15]": "F", "char[12]": "s"}
    return letters[c_type]


def test_the_c_header_is_the_table(tmp_path: Path) -> None:
    source = tmp_path / "question.c"
    source.write_text(question(), "utf-8")
    built = build(tmp_path / "question", source, flags=("-std=c11", "-Wno-conversion"))
    printed = subprocess.run([built], capture_output=True, text=True, check=True).stdout
    assert printed.splitlines() == answer()


def test_the_c_client_stays_small() -> None:
    assert len((SOURCES / "tagmetry_link.c").read_text("utf-8").splitlines()) < 300


def test_the_header_is_c_plus_plus_too(tmp_path: Path) -> None:
    source = tmp_path / "arduino.cpp"
    body = "void setup(tm_robot *r, const uint8_t *key) { tm_begin(r, 3, key); }"
    source.write_text(f'#include "tagmetry_link.h"\n{body}\n', "utf-8")
    command = ["g++", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    try:
        ran = subprocess.run(
            [*command, f"-I{SOURCES}", source], capture_output=True, text=True, check=False
        )
    except FileNotFoundError:
        pytest.skip("needs g++")
    assert ran.returncode == 0, ran.stderr


def c_blake2s(content: bytes, key: bytes, size: int) -> bytes:
    out = ctypes.create_string_buffer(size)
    library().tm_blake2s(out, size, key, len(key), content, len(content))
    return out.raw


def test_blake2s_of_abc_is_that_of_the_rfc() -> None:
    published = "508c5e8c327c14e2e1a72ba34eeb452f37458b209ed63a294d999b4c86675982"  # appendix B
    assert c_blake2s(b"abc", b"", 32).hex() == published


def sequence(length: int, seed: int) -> bytes:
    """Return the bytes of the RFC's self test (appendix E): a Fibonacci generator."""
    a, b, out = 0xDEAD4BAD * seed & 0xFFFFFFFF, 1, bytearray()
    for _ in range(length):
        a, b = b, a + b & 0xFFFFFFFF
        out.append(b >> 24)
    return bytes(out)


def test_blake2s_passes_the_self_test_of_the_rfc() -> None:
    published = "6a411f08ce25adcdfb02aba641451cec53c598b24f4fc787fbdc88797f4c1dfe"
    digests = b""
    for size in (16, 20, 28, 32):
        for length in (0, 3, 64, 65, 255, 1024):
            content, key = sequence(length, length), sequence(size, size)
            digests += c_blake2s(content, b"", size) + c_blake2s(content, key, size)
    assert c_blake2s(digests, b"", 32).hex() == published


@pytest.mark.parametrize("length", [0, 1, 63, 64, 65, 127, 128, 129, 1184])
def test_keyed_blake2s_is_that_of_the_standard_library(length: int) -> None:
    content, key = bytes(n * 7 % 256 for n in range(length)), bytes(range(32))
    expected = hashlib.blake2s(content, key=key, digest_size=16).digest()
    assert c_blake2s(content, key, 16) == expected
