"""Messages to the bytes of a packet's body, and back.

Most bodies are the message's own numbers in order; neighbours and telemetry are lists, and have
files of their own.
"""

import math
import struct

from tagmetry.errors import InputError
from tagmetry.link.layout import COVARIANCES, Kind
from tagmetry.link.messages import (
    KINDS,
    Message,
    Neighbours,
    PackedNeighbours,
    State,
    Telemetry,
)
from tagmetry.link.neighbour_list import pack_neighbours, unpack_neighbours
from tagmetry.link.readings import pack_telemetry, unpack_telemetry
from tagmetry.link.wire import BODIES

_TYPES = {kind: message_type for message_type, kind in KINDS.items()}


def pack_body(message: Message) -> tuple[Kind, bytes]:
    """Return the kind and the body of a packet.

    Raises:
        InputError: A number does not fit, or is not finite.
    """
    kind = KINDS[type(message)]
    if isinstance(message, PackedNeighbours):
        return kind, message.body
    if isinstance(message, Neighbours):
        return kind, pack_neighbours(message)
    if isinstance(message, Telemetry):
        return kind, pack_telemetry(message)
    numbers = _numbers(message)
    try:
        body = BODIES[kind].layout.packing.pack(*numbers)
    except (struct.error, OverflowError, TypeError) as error:
        raise InputError(f"this {kind.name} cannot be sent: {error}; it was {message}") from None
    if not _are_finite(numbers):
        raise InputError(f"this {kind.name} cannot be sent: a number is not finite; {message}")
    return kind, body


def unpack_body(kind: Kind, body: bytes) -> Message | None:
    """Return what a body says; None where that makes no sense.

    Args:
        kind: What the header says it is.
        body: Of a size that `Body.fits`.
    """
    if kind is Kind.NEIGHBOURS:
        return unpack_neighbours(body)
    if kind is Kind.TELEMETRY:
        return unpack_telemetry(body)
    numbers = BODIES[kind].layout.packing.unpack(body)
    if not _are_finite(numbers):
        return None
    if kind is Kind.STATE:
        numbers = (*numbers[:-COVARIANCES], numbers[-COVARIANCES:])
    return _TYPES[kind](*numbers)


def _numbers(message: Message) -> tuple[float, ...]:
    numbers = tuple(vars(message).values())
    return (*numbers[:-1], *message.covariance) if isinstance(message, State) else numbers


def _are_finite(numbers: tuple[float, ...]) -> bool:
    return all(map(math.isfinite, numbers))
