"""Things without markers that stand around: boxes and clutter."""

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin.scenes.path import Path, Still
from tagmetry.twin.scenes.sheet import Print, Sheet
from tagmetry.twin.scenes.thing import Thing

_HERE = Still(RigidTransform.identity())
_MOST_TILT_RAD = 0.6


def box(
    name: str,
    size_m: tuple[float, float, float],
    path: Path = _HERE,
    *,
    brightness: float = 0.4,
) -> Thing:
    """Return a plain box round its origin.

    Args:
        name: What it is called.
        size_m: Its size along x, y and z.
        path: Where it is.
        brightness: Reflectance of its sides.
    """
    x_m, y_m, z_m = size_m
    front = Rotation.from_euler("x", 90, degrees=True)
    around = [Rotation.from_euler("z", angle, degrees=True) * front for angle in (0, 90, 180, 270)]
    sides = [
        *zip(around, ((x_m, z_m, y_m), (y_m, z_m, x_m)) * 2, strict=True),
        (Rotation.identity(), (x_m, y_m, z_m)),
        (Rotation.from_euler("x", 180, degrees=True), (x_m, y_m, z_m)),
    ]
    sheets = tuple(_side(turn, size, brightness) for turn, size in sides)
    return Thing(name, sheets, path=path, scenery=True)


def clutter(
    name: str,
    count: int,
    space_m: tuple[float, float, float],
    size_m: float,
    rng: np.random.Generator,
    path: Path = _HERE,
) -> Thing:
    """Return papers of random sizes, greys and turns, some printed with dark patches.

    Args:
        name: What it is called.
        count: How many.
        space_m: The space round its origin in which their centres are, along x, y and z.
        size_m: Their mean side.
        rng: Where it comes from.
        path: Where it is; they face its z more or less.
    """
    sheets = tuple(_paper(np.array(space_m), size_m, rng) for _ in range(count))
    return Thing(name, sheets, path=path, scenery=True)


def _side(turn: Rotation, size_m: tuple[float, float, float], brightness: float) -> Sheet:
    """Return a side of a box: its width, its height, and the box's depth behind it."""
    width_m, height_m, depth_m = size_m
    outward = turn.apply([0.0, 0.0, depth_m / 2])
    T_thing_sheet = RigidTransform.from_components(outward, turn)
    return Sheet(width_m, height_m, (), T_thing_sheet, paper=brightness)


def _paper(space_m: Array, size_m: float, rng: np.random.Generator) -> Sheet:
    """Return a paper with a few random cells of ink."""
    width_m, height_m = size_m * rng.uniform(0.5, 1.5, 2)
    place = rng.uniform(-0.5, 0.5, 3) * space_m
    tilt = rng.uniform(-_MOST_TILT_RAD, _MOST_TILT_RAD, 2)
    turn = Rotation.from_euler("xyz", [*tilt, rng.uniform(0, 2 * np.pi)])
    rows, columns = rng.integers(1, 7, 2)
    cell_m = 0.8 * min(width_m / columns, height_m / rows)
    ink = rng.uniform(0.0, 1.0, (rows, columns)) * (rng.random((rows, columns)) < 0.5)
    return Sheet(
        float(width_m),
        float(height_m),
        (Print(ink, float(cell_m)),),
        RigidTransform.from_components(place, turn),
        paper=float(rng.uniform(0.3, 0.85)),
        ink=float(rng.uniform(0.05, 0.3)),
    )
