"""A planar robot's camera as it is typed: `x=12cm,z=0.4,up=25`."""

from typing import TYPE_CHECKING

from tagmetry.errors import InputError

if TYPE_CHECKING:
    from tagmetry.localize import PlanarRobot

EXAMPLE = "x=12cm,z=0.4,up=25"
_LENGTHS = ("x", "y", "z", "floor", "bumps")
_ANGLES = ("left", "up", "roll", "tilt")


def parse_planar(text: str) -> "PlanarRobot":
    """Return the robot of a text like `x=12cm,z=0.4,up=25`.

    Args:
        text: x, y, z: the camera's place on the robot, forward, left and up; left, up, roll: where
            it looks, degrees from straight ahead; floor: the floor's height in the world; tilt
            (degrees) and bumps: by how much the robot's tilt and height vary. All may be left out.
    """
    import numpy as np

    from tagmetry.geometry import RigidTransform
    from tagmetry.geometry.transforms import Rotation
    from tagmetry.localize import PlanarRobot

    values = _values(text)
    ahead = Rotation.from_matrix([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
    angles_deg = [values["left"], -values["up"], values["roll"]]
    rotation = Rotation.from_euler("ZYX", angles_deg, degrees=True) * ahead
    T_robot_camera = RigidTransform.from_components([values[k] for k in "xyz"], rotation)
    tilt_rad = float(np.deg2rad(values["tilt"]))
    return PlanarRobot(T_robot_camera, values["floor"], tilt_rad, values["bumps"])


def _values(text: str) -> dict[str, float]:
    values = dict.fromkeys((*_LENGTHS, *_ANGLES), 0.0)
    seen = set()
    for part in text.split(","):
        key, equals, value = part.strip().partition("=")
        if not equals or key not in values or key in seen:
            known = ", ".join(values)
            raise InputError(
                f"expected a planar robot's camera like {EXAMPLE} with some of {known}, found "
                f"{text[:40]!r}"
            )
        seen.add(key)
        values[key] = _length_m(value) if key in _LENGTHS else _degrees(value)
    return values


def _length_m(text: str) -> float:
    from tagmetry.files.lengths import parse_length_m

    sign = -1.0 if text.startswith("-") else 1.0
    bare = text.lstrip("+-")
    return 0.0 if bare.strip("0.") == "" and bare else sign * parse_length_m(bare)


def _degrees(text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise InputError(f"expected an angle in degrees, found {text[:40]!r}") from error
