"""The slider of seed 001: a marker on a cart that moves 0.81 m and turns once about its axis.

The cart starts and ends at rest, with a speed that rises and falls evenly as a cosine. The rail
lies along the camera's x axis, 0.1 m above the floor.
"""

import numpy as np

from tagmetry.arena import Mount, Robot
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rigs.overhead import FAMILY, photographed
from tagmetry.markers import MountedMarker
from tagmetry.twin import Shutter
from tagmetry.twin.scenes import Waypoints, marker_thing

DURATION_S = 4.0
MARKER = Robot(0, "slider", 0.1, FAMILY, 0, 0.08, Mount(0.1))
_LENGTH_M, _TURN_RAD = seed001().slider.length_m, seed001().slider.turns_rad
_START = (-_LENGTH_M / 2, 0.03)
_KNOTS = 81
_SHUTTER = Shutter(exposure_s=0.002, line_s=7e-6)


def way_and_turn(times_s: Array) -> tuple[Array, Array]:
    """Return how far the cart is from its start, and by how much it is turned since."""
    share = (1 - np.cos(np.pi * np.clip(times_s / DURATION_S, 0, 1))) / 2
    return _LENGTH_M * share, _TURN_RAD * share


def places(times_s: Array) -> Array:
    """Return (x, y, heading) in the world, shape (n, 3); the heading grows without end."""
    way_m, turn_rad = way_and_turn(times_s)
    return np.column_stack([_START[0] + way_m, np.full_like(way_m, _START[1]), turn_rad])


def slider_picture(time_s: float, rng: np.random.Generator) -> AnyPixels:
    """Return what the camera sees of the cart while it moves."""
    times_s = np.linspace(0, DURATION_S, _KNOTS)
    at = places(times_s)
    mount = MARKER.mount
    heights_m = np.full((_KNOTS, 1), mount.height_m)
    turns = Rotation.from_euler("z", (at[:, 2:] - np.pi / 2))
    path = Waypoints(
        times_s, RigidTransform.from_components(np.hstack([at[:, :2], heights_m]), turns)
    )
    marker = MountedMarker(
        FAMILY, MARKER.marker_id, MARKER.marker_size_m, RigidTransform.identity()
    )
    return photographed([marker_thing([marker], path)], rng, time_s, _SHUTTER)
