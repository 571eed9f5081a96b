"""The body of TELEMETRY: names of up to twelve ASCII characters, each with a number."""

import struct

from tagmetry.errors import InputError
from tagmetry.link.layout import KEY_CHARACTERS, Kind
from tagmetry.link.messages import Telemetry
from tagmetry.link.wire import BODIES, MOST_READINGS, READING

_HEAD = BODIES[Kind.TELEMETRY].layout.packing
_ITEM = READING.packing


def pack_telemetry(message: Telemetry) -> bytes:
    """Return the body.

    Raises:
        InputError: There are too many readings, or one's name or value does not fit.
    """
    if len(message.readings) > MOST_READINGS:
        count = len(message.readings)
        raise InputError(f"expected at most {MOST_READINGS} readings in a packet, got {count}")
    try:
        head = _HEAD.pack(message.measured_us)
        return head + b"".join(_packed(name, value) for name, value in message.readings)
    except (struct.error, OverflowError, TypeError) as error:
        raise InputError(f"this telemetry cannot be sent: {error}; {message}") from None


def unpack_telemetry(body: bytes) -> Telemetry | None:
    """Return what the body says; None where a name is not printable ASCII."""
    (measured_us,) = _HEAD.unpack_from(body)
    named = [(raw.rstrip(b"\0"), value) for raw, value in _ITEM.iter_unpack(body[_HEAD.size :])]
    if len(named) > MOST_READINGS or not all(_is_name(raw) for raw, _ in named):
        return None
    return Telemetry(measured_us, tuple((raw.decode("ascii"), value) for raw, value in named))


def _packed(name: str, value: float) -> bytes:
    raw = name.encode("utf-8")
    if not _is_name(raw):
        expected = f"1 to {KEY_CHARACTERS} printable ASCII characters"
        raise InputError(f"expected the name of a reading, {expected}, got {name[:40]!r}")
    return _ITEM.pack(raw, value)


def _is_name(raw: bytes) -> bool:
    return 0 < len(raw) <= KEY_CHARACTERS and raw.isascii() and raw.decode("ascii").isprintable()
