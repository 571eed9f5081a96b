"""The sensors and obstacles of an arena's file, checked."""

import numpy as np

from tagmetry.arena import Disc, NeighbourSensor, Obstacle, Wall
from tagmetry.errors import InputError
from tagmetry.files.arena.tables import ObstacleTable, SensorTable
from tagmetry.files.text import named_errors


def sensor_of(table: SensorTable) -> NeighbourSensor:
    """Return a sensor of its table."""
    numbers = {
        name.replace("_deg", "_rad"): np.radians(value) if name.endswith("_deg") else value
        for name, value in table.model_dump().items()
    }
    with named_errors("sensor"):
        return NeighbourSensor(**numbers)


def obstacle_of(number: int, table: ObstacleTable) -> Obstacle:
    """Return an obstacle of its table, the first being number 0."""
    name = table.name if table.name is not None else f"obstacle {number + 1}"
    if table.center_m is not None and table.radius_m is not None and table.from_m is None:
        return Disc(point_of(table.center_m), table.radius_m, name)
    if table.from_m is not None and table.to_m is not None and table.center_m is None:
        return Wall(point_of(table.from_m), point_of(table.to_m), name)
    raise InputError(f"{name}: expected a disc (center_m and radius_m) or a wall (from_m and to_m)")


def point_of(values: list[float]) -> tuple[float, float]:
    """Return a place on the floor."""
    if len(values) != 2:
        raise InputError(f"expected a place [x, y] in metres, found {values}")
    return values[0], values[1]
