"""JSON texts: what Python has and JSON has not becomes null, and what comes in is an object."""

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from tagmetry.errors import InputError

_ENCODER = json.JSONEncoder(separators=(",", ":"), allow_nan=False)


def json_text(value: Mapping[str, object]) -> bytes:
    """Return the text; a number that is not finite becomes null."""
    try:
        return _dumped(value)
    except (TypeError, ValueError):  # it holds what JSON has not
        return _dumped(_plain(value))


def parse_object(text: bytes) -> dict[str, Any]:
    """Return the object that a text holds.

    Raises:
        InputError: It is none.
    """
    try:
        told = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"expected JSON, got something else: {error}") from None
    if not isinstance(told, dict):
        raise InputError("expected a JSON object, got something else")
    return told


def _dumped(value: object) -> bytes:
    return _ENCODER.encode(value).encode()


def _plain(value: object) -> object:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
