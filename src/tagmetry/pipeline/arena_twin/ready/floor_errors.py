"""How accurate the ready-made stage is: a grid of markers as high as the robots' roofs, measured.

As for a real arena: the world is found from five markers on the floor, in one picture; then a grid
is laid out, another picture is taken, and the places of its markers are compared with where they
are. The camera's lens is taken as known.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.arena import AuditGrid, ErrorMap, GridPlace, OverheadView, audit, lay_floor
from tagmetry.detect import Detection, Detector
from tagmetry.geometry import RigidTransform
from tagmetry.markers import MountedMarker
from tagmetry.markers.bodies import MarkerKey
from tagmetry.pipeline.arena_twin.ready.stage import FAMILY, MARKER_SIZE_M, floor, shot
from tagmetry.twin import Scene, photograph
from tagmetry.twin.robots import RobotDesign
from tagmetry.twin.scenes import marker_thing

GRID = AuditGrid(
    24, 13, 0.135, MARKER_SIZE_M, FAMILY, height_m=RobotDesign().roof_height_m
)  # all over where robots are seen whole
_FLOOR_SIZE_M, _FIRST_FLOOR_ID = 0.12, 500
_FLOOR_PLACES_M = ((0.0, 0.0), (1.3, 0.0), (-1.3, 0.55), (-1.2, -0.6), (0.9, 0.65))


def floor_errors(seed: int = 0) -> ErrorMap:
    """Return the errors over the floor.

    Args:
        seed: Of the camera's noise.
    """
    rng = np.random.default_rng(seed)
    view = _view(rng)
    seen = _seen(_lying(GRID.places_m.tolist(), GRID.first_id, GRID.size_m, GRID.height_m), rng)
    return audit(seen, GRID, view, GridPlace())


def _view(rng: np.random.Generator) -> OverheadView:
    """Return the camera over the floor as the floor's markers tell it."""
    seen = _seen(_lying(_FLOOR_PLACES_M, _FIRST_FLOOR_ID, _FLOOR_SIZE_M, 0.0), rng)
    origin, ahead = (MarkerKey(FAMILY, _FIRST_FLOOR_ID + n) for n in range(2))
    return lay_floor(seen, [_FLOOR_SIZE_M] * len(seen), shot().camera, origin, ahead).view


def _lying(
    places_m: Sequence[Sequence[float]], first_id: int, size_m: float, height_m: float
) -> list[MountedMarker]:
    return [
        MountedMarker(
            FAMILY, first_id + n, size_m, RigidTransform.from_translation([*at_m, height_m])
        )
        for n, at_m in enumerate(places_m)
    ]


def _seen(markers: Sequence[MountedMarker], rng: np.random.Generator) -> tuple[Detection, ...]:
    """Return what the detector finds in a picture of markers before nothing."""
    scene = Scene((marker_thing(markers, quiet_cells=1.0),), floor().light)
    above = shot()
    return tuple(Detector([FAMILY]).detect(photograph(scene, above, rng), above.camera))
