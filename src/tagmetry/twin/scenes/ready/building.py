"""What the ready-made scenes are built of: floors, walls, papers on walls.

Frames: the world's z is up, floors are at z = 0.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, family
from tagmetry.twin.scenes.grain import grain
from tagmetry.twin.scenes.path import Still, looking
from tagmetry.twin.scenes.thing import Thing, textured

UP = (0.0, 0.0, 1.0)
_HALF_TURN = RigidTransform.from_rotation(Rotation.from_euler("z", 180, degrees=True))
_CELLS_ALONG = 900


def facing(p_world: Sequence[float], normal: Sequence[float]) -> RigidTransform:
    """Return T_world_sheet of a sheet at a place whose face looks along a direction, upright."""
    place = np.array(p_world, dtype=np.float64)
    return looking(place, place + normal) * _HALF_TURN


def plaster(
    name: str,
    size_m: tuple[float, float],
    T_world_sheet: RigidTransform,
    rng: np.random.Generator,
    brightness: float = 0.6,
) -> Thing:
    """Return a sheet with the faint, even grain of a painted wall."""
    return _grainy(name, size_m, T_world_sheet, rng, (0.93 * brightness, 1.07 * brightness))


def concrete(
    name: str,
    size_m: tuple[float, float],
    T_world_sheet: RigidTransform,
    rng: np.random.Generator,
    brightness: float = 0.4,
) -> Thing:
    """Return a sheet with the mottled grain of a floor."""
    return _grainy(name, size_m, T_world_sheet, rng, (0.75 * brightness, 1.25 * brightness))


def hung(
    name: str, ids: Sequence[int], size_m: float, places: Array, turns_deg: Array
) -> tuple[MountedMarker, ...]:
    """Return markers side by side on a sheet.

    Args:
        name: Of their family.
        ids: Their ids, n.
        size_m: Side of their black squares.
        places: Their centres on the sheet, shape (n, 2), metres.
        turns_deg: How each is turned on it, shape (n,).
    """
    own = family(name)
    return tuple(
        MountedMarker(own.name, own.checked_id(one), size_m, _on_sheet(place, float(turn)))
        for one, place, turn in zip(ids, places, turns_deg, strict=True)
    )


def _grainy(
    name: str,
    size_m: tuple[float, float],
    T_world_sheet: RigidTransform,
    rng: np.random.Generator,
    span: tuple[float, float],
) -> Thing:
    cell_m = max(size_m) / _CELLS_ALONG
    columns, rows = (max(round(length_m / cell_m), 1) for length_m in size_m)
    cells = grain(rows, columns, rng)
    return textured(name, cells, cell_m, Still(T_world_sheet), light=span[1], dark=span[0])


def _on_sheet(place_m: Array, turn_deg: float) -> RigidTransform:
    turn = Rotation.from_euler("z", turn_deg, degrees=True)
    return RigidTransform.from_components([place_m[0], place_m[1], 0.0], turn)
