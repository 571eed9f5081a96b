"""The floor of an arena's file: its markers, checked, and the frame that they make."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.arena.tables import ArenaTable, FloorMarkerTable, FloorTable
from tagmetry.files.board_text import parse_board
from tagmetry.files.families import resolve_family
from tagmetry.files.plain import shortened
from tagmetry.files.text import named_errors
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers.bodies import MarkerKey


@dataclass(frozen=True, eq=False)
class FloorMarker:
    """A marker on the floor.

    Attributes:
        key: Its family and id.
        size_m: Side of its black square.
        T_world_marker: Where it lies; None where calibration finds that.
    """

    key: MarkerKey
    size_m: float
    T_world_marker: RigidTransform | None = None


def floor_of(table: ArenaTable) -> tuple[FloorMarker, ...]:
    """Return the markers on the floor, listed or of a board."""
    if table.floor.board is not None:
        return _board(table.floor.board, table.floor)
    if not table.floor.markers:
        raise InputError(
            "floor.markers: there is none; lay at least one marker on the floor, better four "
            "toward the image's corners, and list them; or lay a board, and name it (floor.board)"
        )
    floor = tuple(_floor_marker(one, table) for one in table.floor.markers)
    keys = [one.key for one in floor]
    for key in keys:
        if keys.count(key) > 1:
            raise InputError(f"floor.markers: {key.family} id {key.id} stands there twice")
    placed = [one.T_world_marker is not None for one in floor]
    if any(placed) and not all(placed):
        raise InputError(
            "floor.markers: some have a place (x_m and y_m) and some have none; measure all, or "
            "leave all to calibration"
        )
    return floor


def _board(text: str, table: FloorTable) -> tuple[FloorMarker, ...]:
    """Return the markers of a board whose frame is the world's."""
    if table.markers:
        raise InputError("floor: expected markers or a board, found both")
    with named_errors("floor.board"):
        markers = parse_board(text).markers()
    if not markers:
        raise InputError(
            f"floor.board: {shortened(text)} has no markers; take a grid or a ChArUco board"
        )
    return tuple(
        FloorMarker(MarkerKey(one.family, one.id), one.size_m, one.T_body_marker) for one in markers
    )


def _floor_marker(one: FloorMarkerTable, table: ArenaTable) -> FloorMarker:
    with named_errors(f"floor marker {one.id}"):
        size_m = one.size_m if one.size_m is not None else table.floor.size_m
        if size_m is None or not 0 < size_m < np.inf:
            raise InputError(f"expected its size_m, here or for all, positive, found {size_m}")
        family = resolve_family(one.family or table.family)
        key = MarkerKey(family.name, family.checked_id(one.id))
        if (one.x_m is None) != (one.y_m is None):
            raise InputError("expected both x_m and y_m, or none of them")
        if one.x_m is None or one.y_m is None:
            return FloorMarker(key, size_m)
        turn = Rotation.from_euler("z", one.turn_deg, degrees=True)
        at = RigidTransform.from_components([one.x_m, one.y_m, 0.0], turn)
        return FloorMarker(key, size_m, at)


def frame_of(
    table: FloorTable, floor: tuple[FloorMarker, ...]
) -> tuple[MarkerKey | None, MarkerKey | None]:
    """Return the markers of the origin and of the x axis."""
    by_id = {one.key.id: one.key for one in floor}
    for name, marker_id in (("origin", table.origin), ("toward", table.toward)):
        if marker_id is not None and marker_id not in by_id:
            listed = ", ".join(map(str, by_id))
            raise InputError(f"floor.{name}: {marker_id} is no floor marker; there are {listed}")
    origin = by_id[table.origin] if table.origin is not None else floor[0].key
    toward = by_id[table.toward] if table.toward is not None else None
    if toward == origin:
        raise InputError("floor.toward: the x axis needs another marker than the origin")
    return (origin, toward) if floor[0].T_world_marker is None else (None, None)
