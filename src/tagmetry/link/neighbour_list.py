"""The body of NEIGHBOURS: millimetres and ten-thousandths of a radian, ten bytes for each."""

import struct
from itertools import chain
from math import remainder, tau
from operator import attrgetter

from tagmetry.errors import InputError
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Neighbour, Neighbours
from tagmetry.link.wire import BODIES, MOST_NEIGHBOURS, NEIGHBOUR

_HEAD = BODIES[Kind.NEIGHBOURS].layout.packing
_ITEM = NEIGHBOUR.packing
_ANGLE_RAD = 1e-4
_FARTHEST_MM = 0xFFFF
_ITEMS = ["<" + _ITEM.format[1:] * count for count in range(MOST_NEIGHBOURS + 1)]


def pack_neighbours(message: Neighbours) -> bytes:
    """Return the body; the nearest come first, and those beyond a hundred are left out.

    Raises:
        InputError: A number does not fit, or is not finite.
    """
    seen = sorted(message.seen, key=attrgetter("range_m"))
    left_out = max(len(seen) - MOST_NEIGHBOURS, 0) + message.omitted
    seen = seen[:MOST_NEIGHBOURS]
    try:
        limit_mm = round(min(1000 * message.range_limit_m, _FARTHEST_MM))
        head = _HEAD.pack(message.captured_us, limit_mm, len(seen), min(left_out, 255))
        return head + struct.pack(_ITEMS[len(seen)], *chain.from_iterable(map(_numbers, seen)))
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


def _numbers(one: Neighbour) -> tuple[int, int, int, int, int, int]:
    return (
        one.id,
        min(round(1000 * one.range_m), _FARTHEST_MM),
        round(remainder(one.bearing_rad, tau) / _ANGLE_RAD),
        round(remainder(one.heading_rad, tau) / _ANGLE_RAD),
        min(round(1000 * one.age_s), 255),
        round(255 * min(max(one.quality, 0.0), 1.0)),
    )


def _neighbour(
    robot: int, range_mm: int, bearing: int, heading: int, age_ms: int, quality: int
) -> Neighbour:
    angles_rad = bearing * _ANGLE_RAD, heading * _ANGLE_RAD
    return Neighbour(robot, range_mm / 1000, *angles_rad, age_ms / 1000, quality / 255)
