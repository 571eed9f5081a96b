"""So many robots under the overhead camera, driving, as a film that is kept in memory."""

from collections.abc import Sequence

import numpy as np

from tagmetry.arena import Mount, Robot
from tagmetry.camera import Image
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.rigs.overhead import FAMILY, photographed
from tagmetry.markers import MountedMarker
from tagmetry.twin.scenes import Steady, marker_thing

PER_S = 120.0
_SIZE_M, _HEIGHT_M = 0.05, 0.05
_COLUMNS, _ROWS = 12, 9
_STEP_M = (0.12, 0.09)
_SPEED_MPS, _TURN_RADPS = 0.2, 0.5


def crowd(count: int) -> tuple[Robot, ...]:
    """Return robots with a marker of 50 mm each."""
    return tuple(
        Robot(n, f"robot {n}", 0.08, FAMILY, n, _SIZE_M, Mount(_HEIGHT_M)) for n in range(count)
    )


def film(count: int, length: int, rng: np.random.Generator) -> list[Image]:
    """Return images of robots that drive and turn, 120 in a second."""
    where = rng.permutation(_COLUMNS * _ROWS)[:count]
    starts = [_start(int(n), rng.uniform(-np.pi, np.pi)) for n in where]
    things = [
        marker_thing(
            [MountedMarker(FAMILY, n, _SIZE_M, RigidTransform.identity())], _driving(start)
        )
        for n, start in enumerate(starts)
    ]
    return [
        Image(photographed(things, rng, k / PER_S), k / PER_S, "capture", k, "crowd")
        for k in range(length)
    ]


def there_and_back(images: Sequence[Image], count: int) -> list[Image]:
    """Return so many images: those, backwards, forwards again, with times that rise."""
    period = 2 * (len(images) - 1)
    turns = [min(k % period, period - k % period) for k in range(count)]
    return [Image(images[n].pixels, k / PER_S, "capture", k, "crowd") for k, n in enumerate(turns)]


def _start(number: int, heading_rad: float) -> RigidTransform:
    row, column = divmod(number, _COLUMNS)
    x_m = _STEP_M[0] * (column - (_COLUMNS - 1) / 2)
    y_m = _STEP_M[1] * (row - (_ROWS - 1) / 2) - 0.04
    return RigidTransform.from_components(
        [x_m, y_m, _HEIGHT_M], Rotation.from_euler("z", heading_rad - np.pi / 2)
    )


def _driving(start: RigidTransform) -> Steady:
    top = start.rotation.apply([0.0, 1.0, 0.0])
    return Steady(start, _SPEED_MPS * top, np.array([0.0, 0.0, _TURN_RADPS]))
