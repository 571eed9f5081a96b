"""Seed 002, tables 1 and 2: one marker in nine zones of the picture, twenty times each.

The paper's error is a constant 10.5 cm, nearly all of it in depth, at a distance that it does not
tell; 4 m is taken. Each picture is measured as it should be, and with one thing made wrong at a
time, to see which mistake gives an error like that.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.lab.beside.seed002_zones import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.localized import Shown, errors, estimates, method_names
from tagmetry.lab.rigs.marker_floor import CAMERA, Stand, camera_place, marker_map, picture
from tagmetry.lab.rows import Localization
from tagmetry.localize import MarkerMap

DISTANCE_M = 4.0
_SCALE = 1.0265  # 10.6 cm at 4 m


@dataclass(frozen=True)
class Case:
    """All pictures of one zone.

    Attributes:
        zone: 0 to 8, row by row from the top left.
        repeats: How many pictures.
        methods: By which each is localized.
    """

    zone: int
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return the nine zones."""
    return tuple(Case(zone, 5 if quick else 20, method_names()) for zone in range(9))


def measure(case: Case, seed: int) -> Sequence[Localization]:
    """Return how far every method is off, with everything right and with one thing wrong."""
    rng = np.random.default_rng(seed)
    stand = Stand("one", DISTANCE_M)
    rows: list[Localization] = []
    for repeat in range(case.repeats):
        T_world_camera = _looking_aside(camera_place(stand, rng), case.zone)
        pixels = picture(stand, T_world_camera, rng)
        for name, places, camera in _assumed(marker_map(stand)):
            shown = Shown(stand, repeat, case.zone, name)
            rows += errors(shown, T_world_camera, estimates(pixels, places, camera))
    return rows


def _looking_aside(T_world_camera: RigidTransform, zone: int) -> RigidTransform:
    """Return the camera moved, without a turn, so that the marker is in the middle of a zone."""
    row, column = divmod(zone, 3)
    size_px = np.array([CAMERA.width_px, CAMERA.height_px])
    off_px = np.array([column - 1, row - 1]) * size_px / 3
    moved = np.array([*(-off_px / CAMERA.focal_px * DISTANCE_M), 0.0])
    return T_world_camera * RigidTransform.from_translation(moved)


def _assumed(right: MarkerMap) -> Iterator[tuple[str, MarkerMap, Camera]]:
    """Give what is taken to be true: all as it is, then one thing wrong at a time."""
    yield "right", right, CAMERA
    grown = tuple(replace(one, size_m=_SCALE * one.size_m) for one in right.markers)
    yield "size 2.65 % too large", replace(right, markers=grown), CAMERA
    (fx, fy), (u, v) = CAMERA.focal_px, CAMERA.center_px
    yield (
        "focal length 2.65 % too long",
        right,
        replace(CAMERA, focal_px=(_SCALE * fx, _SCALE * fy)),
    )
    yield "centre half a pixel off", right, replace(CAMERA, center_px=(u + 0.5, v + 0.5))


EXPERIMENT = Experiment(
    name="seed002-zones",
    title="Does it matter where in the picture the marker is?",
    source="seed 002, tables 1 and 2, figure 26",
    row=Localization,
    cases=cases,
    measure=measure,
    conclude=conclude,
)
