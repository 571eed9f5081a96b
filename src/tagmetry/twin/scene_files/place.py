"""Where a thing or a camera is: `at`, or a `path` through several places.

    at: {translation_m: [0, 0, 1], euler_deg: [90, 0, 0]}
    at: {translation_m: [0, -2, 1], looking_at_m: [0, 0, 1], velocity_m_s: [0.1, 0, 0]}
    path:
      motion: smooth
      waypoints:
        - {time_s: 0, translation_m: [0, -2, 1], looking_at_m: [0, 0, 1]}
        - {time_s: 2, translation_m: [1, -2, 1], looking_at_m: [0, 0, 1]}

What looks at a point turns its face to it: of a camera the lens, of a sheet the print.
"""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from tagmetry.errors import InputError
from tagmetry.files.checked import OwnFileModel
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin.scene_files.fields import Quaternion, Vector
from tagmetry.twin.scenes import Path, Steady, Still, Waypoints, looking

_MOST_WAYPOINTS = 10_000
_FACE_TURN = Rotation.from_euler("z", 180, degrees=True)  # a camera's y is down, a sheet's up
_UNIT = 1e-3


class Place(OwnFileModel):
    """A pose; with one way at most to say how it is turned."""

    translation_m: Vector = Field(default_factory=lambda: [0.0, 0.0, 0.0])
    rotation_xyzw: Quaternion | None = None
    euler_deg: Vector | None = None
    looking_at_m: Vector | None = None

    @model_validator(mode="after")
    def _check_one_turn(self) -> "Place":
        given = (self.rotation_xyzw, self.euler_deg, self.looking_at_m)
        if sum(one is not None for one in given) > 1:
            raise ValueError("give one of rotation_xyzw, euler_deg and looking_at_m")
        if self.rotation_xyzw and abs(np.linalg.norm(self.rotation_xyzw) - 1) > _UNIT:
            raise ValueError(f"rotation_xyzw must have the length 1, found {self.rotation_xyzw}")
        if self.looking_at_m == self.translation_m:
            raise ValueError(f"what is at {self.translation_m} cannot look at itself")
        return self

    def pose(self, *, is_camera: bool) -> RigidTransform:
        """Return T_world_thing."""
        if self.looking_at_m is not None:
            T_world_camera = looking(np.array(self.translation_m), np.array(self.looking_at_m))
            turn = Rotation.identity() if is_camera else _FACE_TURN
            return T_world_camera * RigidTransform.from_rotation(turn)
        return RigidTransform.from_components(self.translation_m, self._rotation())

    def _rotation(self) -> Rotation:
        if self.rotation_xyzw is not None:
            return Rotation.from_quat(self.rotation_xyzw)
        return Rotation.from_euler("xyz", self.euler_deg or [0.0, 0.0, 0.0], degrees=True)


class MovingPlace(Place):
    """A pose at time 0, and the rates at which it changes."""

    velocity_m_s: Vector | None = None
    turn_deg_s: Vector | None = None

    def path(self, *, is_camera: bool) -> Path:
        """Return the path from there."""
        T_world_thing = self.pose(is_camera=is_camera)
        if self.velocity_m_s is None and self.turn_deg_s is None:
            return Still(T_world_thing)
        still = [0.0, 0.0, 0.0]
        turn_rad_s = np.radians(self.turn_deg_s or still)
        return Steady(T_world_thing, np.array(self.velocity_m_s or still), turn_rad_s)


class Waypoint(Place):
    """A pose and its time."""

    time_s: float


class WaypointPath(OwnFileModel):
    """Several poses and how it goes from one to the next."""

    waypoints: Annotated[list[Waypoint], Field(min_length=2, max_length=_MOST_WAYPOINTS)]
    motion: Literal["smooth", "straight"] = "smooth"

    def path(self, *, is_camera: bool) -> Path:
        """Return the path through all poses."""
        times_s = np.array([one.time_s for one in self.waypoints])
        poses = [one.pose(is_camera=is_camera) for one in self.waypoints]
        return Waypoints(times_s, RigidTransform.concatenate(poses), self.motion == "smooth")


def path_of(at: MovingPlace | None, path: WaypointPath | None, *, is_camera: bool) -> Path:
    """Return where something is, of the two ways to say it."""
    if at is not None and path is not None:
        raise InputError("give one of `at` and `path`")
    if path is not None:
        return path.path(is_camera=is_camera)
    return (at or MovingPlace()).path(is_camera=is_camera)
