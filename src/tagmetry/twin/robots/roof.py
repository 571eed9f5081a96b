"""What is to be seen of a robot from above: a dark box with a marker on its roof."""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.arena.robot import Robot
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, family
from tagmetry.twin.scenes import Sheet, Thing, marker_sheet
from tagmetry.twin.scenes.furniture import box

BODY_REFLECTANCE = 0.12
ROOF_CORNERS = 4
_UNIT_SQUARE = np.array([[-0.5, 0.5], [0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]])


@dataclass(frozen=True, eq=False)
class Roof:
    """What is to be seen of a robot.

    Attributes:
        reflectance: Of the roof's cells, a margin of paper around, shape (n, n).
        to_texel: From metres on the roof's sheet to cells, shape (3, 3).
        corners_m: Of the roof's paper, in the robot's frame, shape (4, 3).
        body_m: Corners of the body, in the robot's frame, shape (m, 3).
    """

    reflectance: FloatImage
    to_texel: Array
    corners_m: Array
    body_m: Array

    @property
    def sheet_m(self) -> Array:
        """Corners of the roof's paper, on its sheet, shape (4, 2)."""
        return _UNIT_SQUARE * float(np.linalg.norm(self.corners_m[1] - self.corners_m[0]))


def roof_of(robot: Robot) -> Roof:
    """Return what is to be seen of a robot from above."""
    sheet = _marker_paper(robot)
    cells = _cells(sheet, 1.0 - family(robot.family).picture(robot.marker_id).astype(float))
    side = len(cells)
    scale = side / sheet.width_m
    middle = side / 2 - 0.5
    to_texel = np.array([[scale, 0.0, middle], [0.0, -scale, middle], [0.0, 0.0, 1.0]])
    flat = np.column_stack([_UNIT_SQUARE * sheet.width_m, np.zeros(ROOF_CORNERS)])
    body = body_thing(robot).sheets
    body_m = np.concatenate([one.T_thing_sheet.apply(one.corners_m) for one in body])
    corners_m = np.asarray(sheet.T_thing_sheet.apply(flat))
    return Roof(cells, to_texel, corners_m, np.unique(body_m.round(9), axis=0))


def body_thing(robot: Robot) -> Thing:
    """Return a robot's body: a box as wide as fits into its circle, up to just below its marker."""
    side_m, height_m = robot.diameter_m / np.sqrt(2), robot.mount.height_m - 1e-3
    body = box(robot.name, (side_m, side_m, height_m), brightness=BODY_REFLECTANCE)
    up = RigidTransform.from_translation([0.0, 0.0, height_m / 2])
    sheets = tuple(replace(one, T_thing_sheet=up * one.T_thing_sheet) for one in body.sheets)
    return replace(body, sheets=sheets)


def T_robot_marker(robot: Robot) -> RigidTransform:  # noqa: N802 - a frame's name
    """Return where a robot's marker lies on it; its top is to the front at a turn of 0."""
    mount = robot.mount
    return RigidTransform.from_components(
        [mount.forward_m, mount.left_m, mount.height_m],
        Rotation.from_euler("z", mount.turn_rad - np.pi / 2),
    )


def _marker_paper(robot: Robot) -> Sheet:
    """Return the paper on a robot's roof, with a quiet zone of one cell."""
    return marker_sheet(
        MountedMarker(robot.family, robot.marker_id, robot.marker_size_m, T_robot_marker(robot))
    )


def _cells(sheet: Sheet, ink: Array) -> FloatImage:
    """Return the reflectance of a marker's paper, cell by cell."""
    return np.asarray(sheet.paper + (sheet.ink - sheet.paper) * np.pad(ink, 1), np.float32)
