"""Where a camera or a thing is at a time.

`T_world_thing` maps the thing's coordinates to the world's, whose z is up.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Protocol

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import RotationSpline, Slerp

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation

_TICK_S = 1e-3
_Z_UP = np.array([0.0, 0.0, 1.0])


class Path(Protocol):
    """Where something is, at any time."""

    def at(self, times_s: Array) -> RigidTransform:
        """Return T_world_thing at n times."""

    @property
    def moves(self) -> bool:
        """Whether it ever is at another place."""


@dataclass(frozen=True, eq=False)
class Still:
    """It stays where it is."""

    T_world_thing: RigidTransform

    @property
    def moves(self) -> bool:
        """Never."""
        return False

    def at(self, times_s: Array) -> RigidTransform:
        """Return the one pose, once for every time."""
        count = len(times_s)
        moved = np.broadcast_to(self.T_world_thing.translation, (count, 3))
        turned = Rotation.from_quat(
            np.broadcast_to(self.T_world_thing.rotation.as_quat(), (count, 4))
        )
        return RigidTransform.from_components(moved, turned)


@dataclass(frozen=True, eq=False)
class Steady:
    """It moves and turns at constant rates, both in the world's axes.

    Attributes:
        T_world_thing: Where it is at time 0.
        velocity_m_s: Of its origin, shape (3,).
        turn_rad_s: Its rotation vector per second, shape (3,).
    """

    T_world_thing: RigidTransform
    velocity_m_s: Array
    turn_rad_s: Array

    @property
    def moves(self) -> bool:
        """Whether one of the rates is not zero."""
        return bool(np.any(self.velocity_m_s) or np.any(self.turn_rad_s))

    def at(self, times_s: Array) -> RigidTransform:
        """Return the poses at n times."""
        moved = self.T_world_thing.translation + np.outer(times_s, self.velocity_m_s)
        turned = Rotation.from_rotvec(np.outer(times_s, self.turn_rad_s))
        return RigidTransform.from_components(moved, turned * self.T_world_thing.rotation)


@dataclass(frozen=True, eq=False)
class Waypoints:
    """It passes through poses at given times, and rests before the first and after the last.

    Attributes:
        times_s: Rising, shape (n,), n at least 2.
        Ts_world_thing: The n poses.
        smooth: By splines with continuous acceleration; else straight from pose to pose.
    """

    times_s: Array
    Ts_world_thing: RigidTransform
    smooth: bool = True

    def __post_init__(self) -> None:
        if len(self.times_s) < 2 or len(self.times_s) != len(self.Ts_world_thing):
            raise InputError(
                f"a path needs at least two waypoints, each with its time; got "
                f"{len(self.Ts_world_thing)} poses and {len(self.times_s)} times"
            )
        if not (np.isfinite(self.times_s).all() and (np.diff(self.times_s) > 0).all()):
            raise InputError("the times of a path's waypoints must be finite and rise")

    @property
    def moves(self) -> bool:
        """Always."""
        return True

    def at(self, times_s: Array) -> RigidTransform:
        """Return the poses at n times."""
        within = np.clip(times_s, self.times_s[0], self.times_s[-1])
        return RigidTransform.from_components(self._places(within), self._turns(within))

    def _places(self, times_s: Array) -> Array:
        places = np.asarray(self.Ts_world_thing.translation)
        if self._spline is not None:
            return np.asarray(self._spline(times_s))
        return np.column_stack([np.interp(times_s, self.times_s, axis) for axis in places.T])

    @cached_property
    def _spline(self) -> CubicSpline | None:
        """Through the places; its ends are at rest, so that nothing jerks."""
        if not self.smooth:
            return None
        return CubicSpline(
            self.times_s, np.asarray(self.Ts_world_thing.translation), bc_type="clamped"
        )

    @cached_property
    def _turns(self) -> RotationSpline | Slerp:
        kind = RotationSpline if self.smooth else Slerp
        return kind(self.times_s, self.Ts_world_thing.rotation)


@dataclass(frozen=True, eq=False)
class Along:
    """It goes where a function of time says, straight from one thousandth of a second to the next.

    Attributes:
        T_world_thing_at: From seconds to a pose.
    """

    T_world_thing_at: Callable[[float], RigidTransform]

    @property
    def moves(self) -> bool:
        """Always."""
        return True

    def at(self, times_s: Array) -> RigidTransform:
        """Return the poses at n times."""
        ticks = np.unique(np.floor(np.asarray(times_s) / _TICK_S)).astype(int)
        ticks = np.union1d(ticks, ticks + 1)
        poses = RigidTransform.concatenate([self._pose_at(int(tick)) for tick in ticks])
        return Waypoints(ticks * _TICK_S, poses, smooth=False).at(times_s)

    @cached_property
    def _pose_at(self) -> Callable[[int], RigidTransform]:
        """Return the pose at a tick; kept, as every row of an image asks for its neighbours'."""
        return lru_cache(maxsize=1024)(lambda tick: self.T_world_thing_at(tick * _TICK_S))


def looking(from_m: Array, to_m: Array, up: Array = _Z_UP) -> RigidTransform:
    """Return T_world_camera of a camera at a place that looks at another.

    Args:
        from_m: The camera, world, shape (3,).
        to_m: What is in the middle of the image, world, shape (3,).
        up: Which way is up in the image, world; straight up or down views take the world's y.
    """
    ahead = np.asarray(to_m, dtype=np.float64) - from_m
    if not (np.isfinite(ahead).all() and np.any(ahead)):
        raise InputError(f"a camera at {from_m} cannot look at {to_m}")
    ahead = ahead / np.linalg.norm(ahead)
    down = (up @ ahead) * ahead - up
    if np.linalg.norm(down) < 1e-9:
        down = -np.array([0.0, 1.0, 0.0]) + ahead[1] * ahead
    down /= np.linalg.norm(down)
    R_world_camera = np.column_stack([np.cross(down, ahead), down, ahead])
    return RigidTransform.from_components(from_m, Rotation.from_matrix(R_world_camera))
