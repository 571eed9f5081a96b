"""All rooms of the page but the arena, which stands behind every page."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tagmetry.live.messages import Told
from tagmetry.live.rooms.calibrate.room import calibrate_room
from tagmetry.live.rooms.floor_errors import floor_errors_room
from tagmetry.live.rooms.lens.room import lens_room
from tagmetry.live.rooms.locate.room import locate_room
from tagmetry.live.rooms.printing import printing_room
from tagmetry.live.rooms.recordings import recordings_room
from tagmetry.live.rooms.room import Room
from tagmetry.live.running import Runner


@dataclass(frozen=True)
class Furniture:
    """What rooms work with.

    Attributes:
        camera: That is calibrated: `twin`, or as `tagmetry.pipeline.open_images` understands it.
        cameras: Folder for cameras' files and reports.
        maps: Folder of marker maps, cameras and images to locate from.
    """

    camera: str = "twin"
    cameras: Path = Path("cameras")
    maps: Path = Path("maps")


@contextmanager
def opened_rooms(
    give: Callable[[Told], None], runner: Runner, furniture: Furniture
) -> Iterator[tuple[Room, ...]]:
    """Give the rooms of one server; what runs in them ends with the block.

    Args:
        give: Takes what pages are told, from any thread, and returns at once.
        runner: The arena.
        furniture: What the rooms work with.
    """
    rooms = (
        recordings_room(runner),
        printing_room(),
        floor_errors_room(give),
        calibrate_room(give, furniture.camera, furniture.cameras),
        lens_room(give),
        locate_room(give, furniture.maps),
    )
    try:
        yield rooms
    finally:
        for room in rooms:
            room.close()
