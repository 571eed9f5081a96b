"""The things of a scene file, one table for each kind.

    things:
      - {marker: tag36h11, ids: [7], size: 120mm, at: {translation_m: [0, 0, 1]}}
      - {board: "charuco:7x5:30mm:22mm:5x5_100", at: {translation_m: [0.5, 0, 1]}}

The first key names the kind: marker, board, cube, surface, texture, window, box or clutter.
"""

from collections.abc import Callable
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from tagmetry.errors import InputError
from tagmetry.files.board_text import parse_board
from tagmetry.files.checked import OwnFileModel, checked
from tagmetry.files.plain import shortened
from tagmetry.geometry import RigidTransform
from tagmetry.markers import MarkerBody, MountedMarker, cube, family
from tagmetry.twin.scene_files.fields import (
    Length,
    Lengths2,
    Lengths3,
    NotNegative,
    Positive,
    Share,
)
from tagmetry.twin.scene_files.place import MovingPlace, WaypointPath, path_of
from tagmetry.twin.scene_files.texture import texture_of
from tagmetry.twin.scenes import Path, Thing, board_thing, marker_thing, surface, textured
from tagmetry.twin.scenes.furniture import box, clutter

_MOST_MARKERS = 1000
_MOST_PIECES = 300
_Ids = Annotated[list[int], Field(min_length=1, max_length=_MOST_MARKERS)]


class _Placed(OwnFileModel):
    """What every thing has."""

    at: MovingPlace | None = None
    path: WaypointPath | None = None
    name: str | None = None

    def where(self) -> Path:
        """Return where it is."""
        return path_of(self.at, self.path, is_camera=False)


class _Marker(_Placed):
    """One marker, or several in a row along its x."""

    marker: str
    size: Length
    ids: _Ids = [0]  # noqa: RUF012 (pydantic copies it)
    gap: Length | None = None
    quiet_cells: NotNegative = 1.0

    def thing(self) -> Thing:
        """Return the marker or the row."""
        own = family(self.marker)
        step_m = self.size + (self.gap if self.gap is not None else self.size)
        middle = (len(self.ids) - 1) / 2
        row = [
            MountedMarker(own.name, own.checked_id(one), self.size, _aside((i - middle) * step_m))
            for i, one in enumerate(self.ids)
        ]
        body = MarkerBody(self.name or "markers", tuple(row))
        return marker_thing(
            body.markers, self.where(), name=body.name, quiet_cells=self.quiet_cells
        )


class _Board(_Placed):
    """A board, as `tagmetry calibrate` names it."""

    board: str
    margin: Length = 0.02

    def thing(self) -> Thing:
        """Return the board on its paper."""
        return board_thing(parse_board(self.board), self.where(), margin_m=self.margin)


class _Cube(_Placed):
    """A cube with markers: front, right, back, left, top, bottom; null for a bare face."""

    cube: str
    ids: Annotated[list[int | None], Field(min_length=6, max_length=6)]
    side: Length
    size: Length

    def thing(self) -> Thing:
        """Return a box and the markers on it."""
        own = family(self.cube)
        ids = [None if one is None else own.checked_id(one) for one in self.ids]
        body = cube(self.name or "cube", self.side, self.size, own.name, ids)
        papers = marker_thing(body.markers, quiet_cells=0.0)
        sides = box(body.name, (self.side,) * 3, brightness=0.8)
        return Thing(body.name, (*sides.sheets, *papers.sheets), body.markers, path=self.where())


class _Surface(_Placed):
    """A plain sheet."""

    surface: Lengths2
    brightness: Share = 0.5

    def thing(self) -> Thing:
        """Return the sheet."""
        name = self.name or "surface"
        width_m, height_m = self.surface
        return surface(name, width_m, height_m, self.where(), brightness=self.brightness)


class _Texture(_Placed):
    """A sheet with a checker, with noise, or with a picture."""

    texture: Literal["checker", "noise"] | str
    size: Lengths2
    cell: Length
    light: Share = 0.7
    dark: Share = 0.3
    seed: Annotated[int, Field(ge=0)] = 0

    def thing(self) -> Thing:
        """Return the sheet."""
        cells = texture_of(self.texture, self.size, self.cell, self.seed)
        name = self.name or "texture"
        return textured(name, cells, self.cell, self.where(), light=self.light, dark=self.dark)


class _Window(_Placed):
    """A sheet that glows; white paper in ambient light has a radiance of 0.85."""

    window: Lengths2
    glow: Positive = 8.0

    def thing(self) -> Thing:
        """Return the sheet."""
        name = self.name or "window"
        width_m, height_m = self.window
        where = self.where()
        return surface(name, width_m, height_m, where, brightness=0.0, glow=self.glow)


class _Box(_Placed):
    """A plain box round its origin: its size along x, y and z."""

    box: Lengths3
    brightness: Share = 0.4

    def thing(self) -> Thing:
        """Return the six sides."""
        width_m, depth_m, height_m = self.box
        size_m = (width_m, depth_m, height_m)
        return box(self.name or "box", size_m, self.where(), brightness=self.brightness)


class _Clutter(_Placed):
    """Sheets of random sizes, brightnesses and turns, scattered in a space round its origin."""

    clutter: Annotated[int, Field(ge=1, le=_MOST_PIECES)]
    space: Lengths3
    size: Length = 0.1
    seed: Annotated[int, Field(ge=0)] = 0

    def thing(self) -> Thing:
        """Return all of it as one."""
        width_m, depth_m, height_m = self.space
        space_m = (width_m, depth_m, height_m)
        rng = np.random.default_rng(self.seed)
        return clutter(self.name or "clutter", self.clutter, space_m, self.size, rng, self.where())


_Kind = _Marker | _Board | _Cube | _Surface | _Texture | _Window | _Box | _Clutter
_KINDS: dict[str, Callable[[object], _Kind]] = {
    "marker": lambda table: checked(_Marker, table),
    "board": lambda table: checked(_Board, table),
    "cube": lambda table: checked(_Cube, table),
    "surface": lambda table: checked(_Surface, table),
    "texture": lambda table: checked(_Texture, table),
    "window": lambda table: checked(_Window, table),
    "box": lambda table: checked(_Box, table),
    "clutter": lambda table: checked(_Clutter, table),
}


def thing_of(table: dict[str, object]) -> Thing:
    """Return the thing that a table of a scene file describes.

    Raises:
        InputError: It names no kind or several, or something in it does not fit.
    """
    kinds = [kind for kind in _KINDS if kind in table]
    if len(kinds) != 1:
        found = ", ".join(kinds) or f"the keys {shortened(', '.join(table), 60) or 'none'}"
        raise InputError(f"a thing is one of {', '.join(_KINDS)}; found {found}")
    return _KINDS[kinds[0]](table).thing()


def _aside(x_m: float) -> RigidTransform:
    return RigidTransform.from_translation([x_m, 0.0, 0.0])
