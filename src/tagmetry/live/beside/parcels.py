"""What goes between the arena's program and the server's, through a pipe: parcels.

A parcel is three lengths (4 bytes each, the lowest first), its kind, some values as JSON, and its
load. Nothing is unpickled.
"""

import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, BinaryIO

from pydantic_core import from_json, to_json

_LENGTHS = struct.Struct("<3I")


@dataclass(frozen=True)
class Parcel:
    """One thing that is told.

    Attributes:
        kind: What it is.
        values: What is said with it, as JSON can say it.
        load: Bytes that go with it.
    """

    kind: str
    values: Mapping[str, Any] = field(default_factory=dict)
    load: bytes = b""


def write_parcel(pipe: BinaryIO, parcel: Parcel) -> None:
    """Send a parcel; from one thread at a time.

    Raises:
        OSError: Nobody reads any more.
        ValueError: The pipe was closed.
    """
    kind, values = parcel.kind.encode(), to_json(parcel.values)
    pipe.write(_LENGTHS.pack(len(kind), len(values), len(parcel.load)))
    pipe.write(kind + values + parcel.load)
    pipe.flush()


def parcels(pipe: BinaryIO) -> Iterator[Parcel]:
    """Give what comes, until the other program closes the pipe or ends."""
    while len(head := pipe.read(_LENGTHS.size)) == _LENGTHS.size:
        sizes = _LENGTHS.unpack(head)
        kind, values, load = (pipe.read(size) for size in sizes)
        if len(load) < sizes[2] or len(values) < sizes[1]:
            return  # it ended within a parcel
        yield Parcel(kind.decode(), from_json(values), load)
