"""The bodies of NEIGHBOURS of many robots, packed at once: a robot's is a piece of the whole."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.link.layout import C_FORMATS, Kind
from tagmetry.link.messages import PackedNeighbours
from tagmetry.link.wire import BODIES, MOST_NEIGHBOURS, NEIGHBOUR

_HEAD = BODIES[Kind.NEIGHBOURS].layout.packing
_ITEM = np.dtype([(one.name, "<" + C_FORMATS[one.c_type]) for one in NEIGHBOUR.fields])
_ANGLE_RAD, _PER_M, _PER_S = 1e-4, 1e3, 1e3
_LARGEST = np.array([0xFFFF, *[np.finfo(np.float64).max] * 4])  # of id, range, angles and age


def pack_neighbour_table(
    captured_us: int, limits_m: Sequence[float], sensed: Sequence[Array]
) -> list[PackedNeighbours]:
    """Return what each of n robots is told.

    Args:
        captured_us: When the image was taken, in the host's clock.
        limits_m: The reach of each robot's sensor.
        sensed: Each robot's neighbours, the nearest first: id, range, bearing, heading minus its
            own, and age, shape (k, 5), m, rad and s. Those beyond a hundred are left out.

    Raises:
        InputError: A number does not fit, or is not finite.
    """
    told = [one[:MOST_NEIGHBOURS] for one in sensed]
    ends = np.cumsum([0, *map(len, told)]).tolist()
    items = _items(np.concatenate([np.empty((0, 5)), *told])).tobytes()
    size = _ITEM.itemsize
    return [
        PackedNeighbours(
            _head(captured_us, limit_m, last - first, len(of_robot))
            + items[size * first : size * last]
        )
        for limit_m, of_robot, first, last in zip(
            limits_m, sensed, ends[:-1], ends[1:], strict=True
        )
    ]


def _head(captured_us: int, limit_m: float, count: int, wanted: int) -> bytes:
    limit_mm = round(min(_PER_M * limit_m, 0xFFFF))
    return _HEAD.pack(captured_us, limit_mm, count, min(wanted - count, 255))


def _items(numbers: Array) -> NDArray[np.void]:
    """Return the wire's integers of neighbours, shape (m,)."""
    is_right = (numbers[:, [0, 1, 4]] >= 0).all(axis=1) & (np.abs(numbers) <= _LARGEST).all(axis=1)
    if not is_right.all():
        odd = numbers[~is_right][0].tolist()
        raise InputError(f"this neighbour cannot be sent: id, range, angles and age were {odd}")
    items = np.empty(len(numbers), dtype=_ITEM)
    items["id"] = numbers[:, 0]
    items["range_mm"] = np.minimum(np.rint(_PER_M * numbers[:, 1]), 0xFFFF)
    turns = numbers[:, 2:4]
    turns = turns - 2 * np.pi * np.rint(turns / (2 * np.pi))
    items["bearing"], items["heading"] = np.rint(turns / _ANGLE_RAD).T
    items["age_ms"] = np.minimum(np.rint(_PER_S * numbers[:, 4]), 0xFF)
    items["quality"] = 0xFF
    return items
