"""All rooms of the page but the arena, which stands behind every page."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tagmetry.live.messages import Told
from tagmetry.live.rooms.floor_errors import floor_errors_room
from tagmetry.live.rooms.printing import printing_room
from tagmetry.live.rooms.recordings import recordings_room
from tagmetry.live.rooms.room import Room
from tagmetry.live.running import Runner


@contextmanager
def opened_rooms(give: Callable[[Told], None], runner: Runner) -> Iterator[tuple[Room, ...]]:
    """Give the rooms of one server; what runs in them ends with the block.

    Args:
        give: Takes what pages are told, from any thread.
        runner: The arena.
    """
    rooms = (recordings_room(runner), printing_room(), floor_errors_room(give))
    try:
        yield rooms
    finally:
        for room in rooms:
            room.close()
