"""What is known of the camera's pose beside the markers: where up is, how high a point stands.

Each says a little of the six numbers of the pose, with a deviation, and enters the joint solution
as a measurement does. A robot on a flat floor is both: its up is the world's, and its foot stands
on the floor. What is left is x, y and the heading.

A single marker is then no longer ambiguous where it is seen clearly from below or above: its mirror
pose leans by twice that angle. Level with the camera, an upright marker that is turned a little to
the left looks as one turned to the right, floor or not; both poses are given.
"""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform

_LEAST = 1e-6  # m or rad; stands for exact, and the equations stay solvable


@dataclass(frozen=True, eq=False)
class Gravity:
    """The direction of the world's up as the camera's frame has it, from an accelerometer.

    Attributes:
        up_camera: Shape (3,), any length but zero.
        deviation_rad: Standard deviation about each of the two level axes.
    """

    up_camera: Array
    deviation_rad: float

    def __post_init__(self) -> None:
        length = float(np.linalg.norm(self.up_camera))
        if np.shape(self.up_camera) != (3,) or not 0 < length < np.inf:
            raise InputError(f"up_camera must be three numbers, not all 0, got {self.up_camera}")
        _check_deviation("deviation_rad", self.deviation_rad)


@dataclass(frozen=True, eq=False)
class Height:
    """How high a point of the camera's rig stands in the world.

    Attributes:
        p_camera: The point, shape (3,), metres; zero for the camera itself.
        z_m: Its height in the world.
        deviation_m: Standard deviation of that.
    """

    p_camera: Array
    z_m: float
    deviation_m: float

    def __post_init__(self) -> None:
        if np.shape(self.p_camera) != (3,) or not np.isfinite(self.p_camera).all():
            raise InputError(f"p_camera must be three finite numbers, got {self.p_camera}")
        if not np.isfinite(self.z_m):
            raise InputError(f"z_m must be finite, got {self.z_m}")
        _check_deviation("deviation_m", self.deviation_m)


@dataclass(frozen=True)
class Knowledge:
    """All that is known beside the markers.

    Attributes:
        ups: Where up is.
        heights: How high points stand.
    """

    ups: tuple[Gravity, ...] = ()
    heights: tuple[Height, ...] = ()

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known."""
        return not self.ups and not self.heights

    def __add__(self, other: "Knowledge") -> "Knowledge":
        """Return what both say."""
        return Knowledge(self.ups + other.ups, self.heights + other.heights)


@dataclass(frozen=True, eq=False)
class PlanarRobot:
    """A robot that drives on a level floor, and how its camera is mounted.

    Frames: `robot` has x forward, y to its left, z up, its origin on the floor.

    Attributes:
        T_robot_camera: The camera on the robot.
        floor_m: Height of the floor in the world.
        tilt_deviation_rad: By how much the robot's up departs from the world's about each axis:
            an uneven floor, a mounting that is not quite known; 0 for exact.
        height_deviation_m: The same for the height.
    """

    T_robot_camera: RigidTransform
    floor_m: float = 0.0
    tilt_deviation_rad: float = 0.0
    height_deviation_m: float = 0.0
    knowledge: Knowledge = field(init=False)

    def __post_init__(self) -> None:
        T_camera_robot = self.T_robot_camera.inv()
        up_camera = T_camera_robot.rotation.apply([0.0, 0.0, 1.0])
        up = Gravity(up_camera, self.tilt_deviation_rad)
        foot = Height(np.asarray(T_camera_robot.translation), self.floor_m, self.height_deviation_m)
        object.__setattr__(self, "knowledge", Knowledge((up,), (foot,)))


def _check_deviation(name: str, value: float) -> None:
    if not 0 <= value < np.inf:
        raise InputError(f"{name} must be finite and not negative, got {value}")


def known_rows(known: Knowledge) -> Array:
    """Return what is known as rows (n, 6): see `joint.scene.Scene.known`."""
    rows = [
        [*(one.up_camera / np.linalg.norm(one.up_camera)), 0.0, _sharp(one.deviation_rad), 0.0]
        for one in known.ups
    ]
    rows += [[*one.p_camera, one.z_m, _sharp(one.deviation_m), 1.0] for one in known.heights]
    return np.array(rows, dtype=np.float64).reshape(-1, 6)


def _sharp(deviation: float) -> float:
    return 1.0 / max(deviation, _LEAST)
