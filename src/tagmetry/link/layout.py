"""What a packet is made of: fields of C types, one after another, little-endian and packed."""

import struct
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property
from typing import Literal

KEY_CHARACTERS = 12  # in the name of a reading
COVARIANCES = 15  # of five numbers, each pair once

C_FORMATS = {
    "uint8_t": "B",
    "int16_t": "h",
    "uint16_t": "H",
    "uint32_t": "I",
    "uint64_t": "Q",
    "float": "f",
    f"char[{KEY_CHARACTERS}]": f"{KEY_CHARACTERS}s",
    f"float[{COVARIANCES}]": f"{COVARIANCES}f",
}

Sender = Literal["robot", "host", "arena"]  # the arena is the host as it speaks to all


class Kind(IntEnum):
    """What a packet is about; the numbers are on the wire."""

    HELLO = 1
    ASSIGN = 2
    TIME = 3
    TIME_REPLY = 4
    BEAT = 5
    ESTOP = 6
    POSE = 7
    NEIGHBOURS = 8
    COMMAND = 9
    ODOMETRY = 10
    TELEMETRY = 11
    STATE = 12
    ARENA = 13


@dataclass(frozen=True)
class Field:
    """One number of a packet: its name, its type in C, and what it says."""

    name: str
    c_type: str
    meaning: str


@dataclass(frozen=True)
class Layout:
    """Numbers one after another, without gaps; `name` is that of the C struct without `tm_`."""

    name: str
    fields: tuple[Field, ...]

    @cached_property
    def packing(self) -> struct.Struct:
        """What packs and unpacks it."""
        return struct.Struct("<" + "".join(C_FORMATS[field.c_type] for field in self.fields))

    @property
    def size_bytes(self) -> int:
        """How long it is."""
        return self.packing.size

    def offsets_bytes(self) -> dict[str, int]:
        """Return where each field begins."""
        ends = [struct.calcsize("<" + C_FORMATS[field.c_type]) for field in self.fields]
        return {field.name: sum(ends[:index]) for index, field in enumerate(self.fields)}


@dataclass(frozen=True)
class Body:
    """What follows the header in one kind of packet.

    Attributes:
        kind: Which.
        sender: Who sends it; from the other side it is refused.
        layout: What comes once.
        item: What follows, any number of times; None where nothing does.
        meaning: What it is for.
    """

    kind: Kind
    sender: Sender
    layout: Layout
    meaning: str
    item: Layout | None = None

    def fits(self, size_bytes: int) -> bool:
        """Say whether a body can be of this size."""
        rest_bytes = size_bytes - self.layout.size_bytes
        if self.item is None:
            return rest_bytes == 0
        return rest_bytes >= 0 and rest_bytes % self.item.size_bytes == 0
