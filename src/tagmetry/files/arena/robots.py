"""The robots of an arena's file, checked."""

import re

import numpy as np

from tagmetry.arena import Mount, Robot
from tagmetry.errors import InputError
from tagmetry.files.arena.tables import ArenaTable, RobotTable
from tagmetry.files.families import resolve_family
from tagmetry.files.text import named_errors

_KEY = re.compile(r"[0-9a-fA-F]{64}")


def robot_of(one: RobotTable, table: ArenaTable) -> Robot:
    """Return a robot of its table, and of what the arena says of all robots."""
    with named_errors(f"robot {one.id}"):
        size_m = one.marker.size_m if one.marker.size_m is not None else table.marker_size_m
        diameter_m = one.diameter_m if one.diameter_m is not None else table.diameter_m
        if size_m is None:
            raise InputError("the size of its marker is missing: marker.size_m, or marker_size_m")
        if diameter_m is None:
            raise InputError("its diameter is missing: diameter_m, here or for all robots")
        mount = Mount(
            one.marker.height_m,
            one.marker.forward_m,
            one.marker.left_m,
            float(np.radians(one.marker.turn_deg)),
            one.marker.height_sd_m,
        )
        family = resolve_family(one.marker.family or table.family)
        name = one.name if one.name is not None else f"robot {one.id}"
        return Robot(
            one.id,
            name,
            diameter_m,
            family.name,
            family.checked_id(one.marker.id),
            size_m,
            mount,
            key_of(one.key),
        )


def key_of(text: str | None) -> bytes | None:
    """Return the 32 bytes of a key; None where there is none."""
    if text is None:
        return None
    if not _KEY.fullmatch(text):
        raise InputError(
            f"expected a key of 64 hexadecimal digits, found {len(text)} characters that are not; "
            "make one with tagmetry.link.new_key(), and put it in quotes"
        )
    return bytes.fromhex(text)
