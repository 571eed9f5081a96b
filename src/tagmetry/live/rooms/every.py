"""All rooms of the page but the arena, which stands behind every page."""

from collections.abc import Iterator
from contextlib import contextmanager

from tagmetry.live.rooms.printing import printing_room
from tagmetry.live.rooms.room import Room


@contextmanager
def opened_rooms() -> Iterator[tuple[Room, ...]]:
    """Give the rooms of one server; what runs in them ends with the block."""
    rooms = (printing_room(),)
    try:
        yield rooms
    finally:
        for room in rooms:
            room.close()
