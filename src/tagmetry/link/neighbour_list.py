"""The body of NEIGHBOURS: millimetres and ten-thousandths of a radian, ten bytes for each."""

import math
import struct

from tagmetry.errors import InputError
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Neighbour, Neighbours
from tagmetry.link.wire import BODIES, MOST_NEIGHBOURS, NEIGHBOUR

_HEAD = BODIES[Kind.NEIGHBOURS].layout.packing
_ITEM = NEIGHBOUR.packing
_ANGLE_RAD = 1e-4
_FARTHEST_MM = 0xFFFF


def pack_neighbours(message: Neighbours) -> bytes:
    """Return the body; the nearest come first, and those beyond a hundred are left out.

    Raises:
        InputError: A number does not fit, or is not finite.
    """
    seen = sorted(message.seen, key=lambda one: one.range_m)
    left_out = max(len(seen) - MOST_NEIGHBOURS, 0) + message.omitted
    seen = seen[:MOST_NEIGHBOURS]
    try:
        limit_mm = _millimetres(message.range_limit_m)
        head = _HEAD.pack(message.captured_us, limit_mm, len(seen), min(left_out, 255))
        return head + b"".join(map(_packed, seen))
    except (struct.error, ValueError, OverflowError) as error:
        raise InputError(f"these neighbours cannot be sent: {error}; {message}") from None


def unpack_neighbours(body: bytes) -> Neighbours | None:
    """Return what the body says; None where its count does not fit its size."""
    captured_us, limit_mm, count, omitted = _HEAD.unpack_from(body)
    items = body[_HEAD.size :]
    if len(items) != count * _ITEM.size:
        return None
    seen = tuple(_neighbour(*numbers) for numbers in _ITEM.iter_unpack(items))
    return Neighbours(captured_us, limit_mm / 1000, seen, omitted)


def _packed(one: Neighbour) -> bytes:
    return _ITEM.pack(
        one.id,
        _millimetres(one.range_m),
        _ten_thousandths(one.bearing_rad),
        _ten_thousandths(one.heading_rad),
        min(round(1000 * one.age_s), 255),
        round(255 * min(max(one.quality, 0.0), 1.0)),
    )


def _neighbour(
    robot: int, range_mm: int, bearing: int, heading: int, age_ms: int, quality: int
) -> Neighbour:
    angles_rad = bearing * _ANGLE_RAD, heading * _ANGLE_RAD
    return Neighbour(robot, range_mm / 1000, *angles_rad, age_ms / 1000, quality / 255)


def _millimetres(length_m: float) -> int:
    return _FARTHEST_MM if length_m == math.inf else min(round(1000 * length_m), _FARTHEST_MM)


def _ten_thousandths(angle_rad: float) -> int:
    return round(math.remainder(angle_rad, math.tau) / _ANGLE_RAD)
