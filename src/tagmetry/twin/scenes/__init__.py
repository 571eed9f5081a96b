"""What there is to see: things made of printed sheets, light, and paths through them."""

from tagmetry.twin.scenes.held import Held
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Along, Path, Steady, Still, Waypoints, looking
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.sheet import Dot, Print, Sheet
from tagmetry.twin.scenes.thing import (
    Thing,
    board_thing,
    body_thing,
    marker_sheet,
    marker_thing,
    surface,
    textured,
)

__all__ = [
    "Along",
    "Dot",
    "Held",
    "Lamp",
    "Light",
    "Path",
    "Print",
    "Scene",
    "Sheet",
    "Steady",
    "Still",
    "Thing",
    "Waypoints",
    "board_thing",
    "body_thing",
    "looking",
    "marker_sheet",
    "marker_thing",
    "surface",
    "textured",
]
