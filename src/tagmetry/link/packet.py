"""One packet: header, body and tag; sealing it, and what may be wrong with one that arrives.

The tag is keyed BLAKE2s of 128 bits (RFC 7693) over header and body: made for 32-bit processors, in
Python's standard library, and sixty lines of C.
"""

import hmac
import struct
from enum import StrEnum
from hashlib import blake2s
from typing import NamedTuple

from tagmetry.link.layout import Kind, Sender
from tagmetry.link.wire import BODIES, FRAME_BYTES, HEADER, MAGIC, MOST_BYTES, TAG_BYTES, VERSION

_PACKING: struct.Struct = HEADER.packing
_KINDS = {int(kind): kind for kind in Kind}


class Refusal(StrEnum):
    """Why a packet was not accepted."""

    FORM = "no packet of this protocol and version"
    SENDER = "from the wrong side, or a robot that is not known"
    SESSION = "of no session that is open"
    TAG = "not sealed with the right key"
    REPLAYED = "seen before, or too old to tell"
    LATE = "too long on its way"
    CONTENT = "sealed, but its content makes no sense"


class Header(NamedTuple):
    """What a packet says of itself; true only once its tag was checked."""

    kind: Kind
    robot: int
    sent_us: int
    counter: int
    session: int


def seal(key: bytes, header: Header, body: bytes) -> bytes:
    """Return a packet."""
    head = _PACKING.pack(
        MAGIC,
        VERSION,
        header.kind,
        header.robot,
        len(body),
        header.sent_us,
        header.counter,
        header.session,
    )
    return head + body + _tag(key, head + body)


def read_header(packet: bytes, sender: Sender) -> Header | Refusal:
    """Return the header of a packet that may come from that side."""
    if not FRAME_BYTES <= len(packet) <= MOST_BYTES:
        return Refusal.FORM
    magic, version, number, robot, body_bytes, sent_us, counter, session = _PACKING.unpack_from(
        packet
    )
    kind = _KINDS.get(number)
    if (magic, version) != (MAGIC, VERSION) or kind is None:
        return Refusal.FORM
    if body_bytes != len(packet) - FRAME_BYTES or not BODIES[kind].fits(body_bytes):
        return Refusal.FORM
    if BODIES[kind].sender != sender:
        return Refusal.SENDER
    return Header(kind, robot, sent_us, counter, session)


def body_of(packet: bytes) -> bytes:
    """Return the body of a packet whose header was read."""
    return packet[HEADER.size_bytes : -TAG_BYTES]


def is_sealed_with(key: bytes, packet: bytes) -> bool:
    """Say whether the tag is right; takes the same time wherever it differs."""
    return hmac.compare_digest(_tag(key, packet[:-TAG_BYTES]), packet[-TAG_BYTES:])


def _tag(key: bytes, content: bytes) -> bytes:
    return blake2s(content, key=key, digest_size=TAG_BYTES).digest()
