"""Ready-made scenes: functions with parameters that return a recipe for pictures."""

from tagmetry.twin.scenes.ready.arena import arena
from tagmetry.twin.scenes.ready.backlit import backlit_window
from tagmetry.twin.scenes.ready.choose import READY, ready_recipe
from tagmetry.twin.scenes.ready.corridor import corridor
from tagmetry.twin.scenes.ready.floor import floor
from tagmetry.twin.scenes.ready.room import room
from tagmetry.twin.scenes.ready.sweep import board_sweep
from tagmetry.twin.scenes.ready.wall import wall

__all__ = [
    "READY",
    "arena",
    "backlit_window",
    "board_sweep",
    "corridor",
    "floor",
    "ready_recipe",
    "room",
    "wall",
]
