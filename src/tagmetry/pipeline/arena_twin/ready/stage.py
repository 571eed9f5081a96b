"""The stage of the ready-made scenarios: a ceiling camera over a concrete floor."""

import numpy as np

from tagmetry.arena import Mount, OverheadView, Robot
from tagmetry.arena.place import Place
from tagmetry.twin.rendering import Shot
from tagmetry.twin.robots import RobotDesign
from tagmetry.twin.scenes import Lamp, Light, Scene, Still
from tagmetry.twin.scenes.path import looking
from tagmetry.twin.scenes.ready.building import UP, concrete, facing
from tagmetry.twin.scenes.ready.photographer import machine_camera

FAMILY, MARKER_SIZE_M, MOST_ROBOTS = "tag36h11", 0.09, 100
HEIGHT_M, _FIELD_OF_VIEW_DEG = 2.6, 70.0
FLOOR_HALF_M = (1.6, 0.85)  # where robots are seen whole
RIM_M = 0.15  # of the floor, where no robot starts


def shot(height_m: float = HEIGHT_M) -> Shot:
    """Return the camera at its place: 1920x1080, 70 degrees, so high above the floor."""
    above = looking(np.array([0.0, 0.0, height_m]), np.zeros(3))
    return machine_camera(Still(above), _FIELD_OF_VIEW_DEG)


def view(height_m: float = HEIGHT_M) -> OverheadView:
    """Return what the arena believes of the camera: the truth, without an error."""
    own = shot(height_m)
    return OverheadView(own.camera, own.path.at(np.zeros(1))[0], np.zeros((6, 6)))


def floor(seed: int = 0) -> Scene:
    """Return a floor of concrete under two lamps."""
    rng = np.random.default_rng(seed)
    ground = concrete("floor", (5.2, 3.4), facing((0.0, 0.0, 0.0), UP), rng, brightness=0.35)
    lamps = (Lamp(np.array([-1.2, 0.6, 3.5]), 3.0), Lamp(np.array([1.3, -0.5, 3.5]), 3.0))
    return Scene((ground,), Light(0.6, lamps))


def robot(number: int) -> Robot:
    """Return one of the seed's robots, 160 mm across, with the marker of its number."""
    design = RobotDesign()
    mount = Mount(design.roof_height_m)
    return Robot(number, f"robot {number}", design.diameter_m, FAMILY, number, MARKER_SIZE_M, mount)


def scattered(
    count: int,
    rng: np.random.Generator,
    apart_m: float = 0.3,
    half_m: tuple[float, float] = FLOOR_HALF_M,
) -> list[Place]:
    """Return places all over the floor, no two nearer than what room there is allows."""
    half = np.array(half_m) - RIM_M  # robots start whole within
    columns = int(np.ceil(np.sqrt(count * half[0] / half[1])))
    rows = int(np.ceil(count / columns))
    cell_m = 2 * half / [columns, rows]
    loose_m = np.clip((cell_m - apart_m) / 2, 0.0, None)
    number = np.arange(count)
    cells = np.column_stack([number % columns, number // columns]) + 0.5
    xy = cells * cell_m - half + rng.uniform(-1, 1, (count, 2)) * loose_m
    return [Place(x_m, y_m, rng.uniform(-np.pi, np.pi)) for x_m, y_m in xy.tolist()]
