"""Where a flat marker or board is, as the picture shows it, and the pose that this is.

Frames: `camera` x right, y down, z forward; `target`, a marker or board, x right, y up, z out of
its face.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation


@dataclass(frozen=True)
class Place:
    """Where a marker or board is; its upper edge is up in the picture.

    Attributes:
        pixel: Its centre, (u, v).
        distance_m: From the camera to its centre.
        tilt_deg: Between its normal and the line to the camera.
        direction_deg: To which side of the picture its face is turned: 0 right, 90 down.
    """

    pixel: tuple[float, float]
    distance_m: float
    tilt_deg: float = 30.0
    direction_deg: float = 0.0


def poses_at(camera: Camera, places: Sequence[Place]) -> RigidTransform:
    """Return Ts_camera_target at n places.

    Raises:
        InputError: The lens shows nothing at one of them.
    """
    rays = camera.unproject(np.array([place.pixel for place in places]))
    shown = np.isfinite(rays).all(axis=1)
    if not shown.all():
        dark = places[int(np.argmin(shown))].pixel
        raise InputError(f"the lens shows nothing at pixel {dark}; choose a place that it shows")
    upright = Rotation.from_matrix(_facing(rays))
    side = np.radians([place.direction_deg for place in places])
    angle = np.radians([place.tilt_deg for place in places])
    axes_target = np.stack([np.sin(side), np.cos(side), np.zeros_like(side)], axis=1)
    turned = upright * Rotation.from_rotvec(angle[:, None] * axes_target)
    distances = np.array([[place.distance_m] for place in places])
    return RigidTransform.from_components(rays * distances, turned)


def _facing(rays: Array) -> Array:
    """Return Rs_camera_target of what faces the camera upright along rays (n, 3)."""
    right = np.cross([0.0, 1.0, 0.0], rays)
    right = right / np.linalg.norm(right, axis=1, keepdims=True)
    return np.stack([right, np.cross(right, rays), -rays], axis=2)
