"""The axes of a marker, and the cube that stands on it, as paths in the image.

Marker frame: origin at the centre, x right, y up, z out of the printed face.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera.model import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.record.palette import AXES, YELLOW, Color

POINTS_PER_EDGE = 9  # enough that a bent edge looks bent

SQUARE = np.array([[-0.5, 0.5], [0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]])


@dataclass(frozen=True)
class Wire:
    """A straight edge in space and where the camera sees it.

    Attributes:
        points_px: Shape (n, 2); NaN where the camera does not show it.
        color: Blue, green, red.
    """

    points_px: Array
    color: Color


def axis_wires(T_camera_marker: RigidTransform, camera: Camera, size_m: float) -> list[Wire]:
    """Return the axes x, y and z, half a marker long, the farthest first."""
    tips = np.eye(3) * size_m / 2
    edges = np.stack([np.zeros((3, 3)), tips], axis=1)
    return _seen(edges, list(AXES), T_camera_marker, camera)


def cube_wires(T_camera_marker: RigidTransform, camera: Camera, size_m: float) -> list[Wire]:
    """Return the cube that stands on the marker, without its floor, the farthest edge first."""
    floor = np.pad(SQUARE, ((0, 0), (0, 1))) * size_m
    top = floor + np.array([0.0, 0.0, size_m])
    starts, ends = np.concatenate([floor, top]), np.concatenate([top, top[[1, 2, 3, 0]]])
    edges = np.stack([starts, ends], axis=1)
    return _seen(edges, [YELLOW] * len(edges), T_camera_marker, camera)


def _seen(
    edges_m: Array, colors: list[Color], T_camera_marker: RigidTransform, camera: Camera
) -> list[Wire]:
    """Return edges (n, 2, 3) of the marker frame as wires, the farthest first."""
    along = np.linspace(0.0, 1.0, POINTS_PER_EDGE)[:, None]
    p_marker = edges_m[:, :1] * (1.0 - along) + edges_m[:, 1:] * along
    p_camera = T_camera_marker.apply(p_marker.reshape(-1, 3)).reshape(p_marker.shape)
    pixels = camera.project(p_camera)
    farthest_first = np.argsort(-np.linalg.norm(p_camera.mean(axis=1), axis=1), kind="stable")
    return [Wire(pixels[edge], colors[edge]) for edge in farthest_first]
