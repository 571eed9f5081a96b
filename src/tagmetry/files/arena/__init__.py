"""An arena's files: what there is, as a person writes it, and its world, as it was measured."""

from tagmetry.files.arena.computers import ZenohSetup
from tagmetry.files.arena.floor import FloorMarker
from tagmetry.files.arena.setup import ArenaSetup, load_arena
from tagmetry.files.arena.virtual import with_virtual
from tagmetry.files.arena.world import ArenaWorld, load_world, save_world

__all__ = [
    "ArenaSetup",
    "ArenaWorld",
    "FloorMarker",
    "ZenohSetup",
    "load_arena",
    "load_world",
    "save_world",
    "with_virtual",
]
