"""Rigid bodies that carry several markers, in one plane or in several.

Frames: `marker` has its origin at the centre, x to its right, y to its top, z out of its face.
`body` is the body's own. Corners go clockwise from the marker's own top left.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation

_UNIT_CORNERS = np.array([[-0.5, 0.5, 0.0], [0.5, 0.5, 0.0], [0.5, -0.5, 0.0], [-0.5, -0.5, 0.0]])


class MarkerKey(NamedTuple):
    """What tells one marker of a body from another."""

    family: str
    id: int


def marker_corners_m(size_m: Array | float) -> Array:
    """Return a marker's corners in its own frame, shape (..., 4, 3), metres.

    Args:
        size_m: Side of the black square, shape (...).
    """
    side_m = np.asarray(size_m, dtype=np.float64)
    return np.asarray(side_m[..., None, None] * _UNIT_CORNERS)


@dataclass(frozen=True)
class MountedMarker:
    """A marker at its place on a body.

    Attributes:
        family: Name of its family.
        id: Its id.
        size_m: Side of its black square.
        T_body_marker: Where it is and how it is turned.
    """

    family: str
    id: int
    size_m: float
    T_body_marker: RigidTransform

    @property
    def corners_m(self) -> Array:
        """Its corners in the body's frame, shape (4, 3)."""
        return np.asarray(self.T_body_marker.apply(marker_corners_m(self.size_m)))


@dataclass(frozen=True)
class MarkerBody:
    """Several markers that move as one."""

    name: str
    markers: tuple[MountedMarker, ...]

    def __post_init__(self) -> None:
        times = Counter((marker.family, marker.id) for marker in self.markers)
        if repeated := [key for key, count in times.items() if count > 1]:
            family, marker_id = min(repeated)
            raise InputError(
                f"body {self.name!r} has {family} id {marker_id} twice; a marker is named by its "
                "family and id and may stand on a body once"
            )

    @property
    def corners_m(self) -> Mapping[MarkerKey, Array]:
        """The corners of every marker in the body's frame, each (4, 3), metres."""
        return {MarkerKey(m.family, m.id): m.corners_m for m in self.markers}


def cube(
    name: str, side_m: float, size_m: float, family: str, ids: Sequence[int | None]
) -> MarkerBody:
    """Return a cube with a marker on up to six faces, each upright seen from outside.

    Args:
        name: What the body is called.
        side_m: Edge of the cube; its centre is the body's origin.
        size_m: Side of the markers' black squares.
        family: Their family.
        ids: For the faces front (-y), right (+x), back (+y), left (-x), top (+z), bottom (-z); None
            for a bare face.
    """
    if len(ids) != 6:
        raise InputError(f"a cube has six faces, got {len(ids)} ids; give None for a bare face")
    if not 0 < size_m <= side_m < np.inf:
        raise InputError(f"a marker of {size_m} m does not fit a cube's face of {side_m} m")
    mounted = [
        MountedMarker(family, marker_id, size_m, _on_face(R_body_marker, side_m))
        for marker_id, R_body_marker in zip(ids, _cube_faces(), strict=True)
        if marker_id is not None
    ]
    return MarkerBody(name, tuple(mounted))


def _on_face(R_body_marker: Rotation, side_m: float) -> RigidTransform:
    outward = R_body_marker.apply([0.0, 0.0, side_m / 2])
    return RigidTransform.from_components(outward, R_body_marker)


def _cube_faces() -> list[Rotation]:
    """Return R_body_marker of the six faces: z outward, y up (top and bottom: y to the back)."""
    front = Rotation.from_euler("x", 90, degrees=True)
    around = [Rotation.from_euler("z", angle, degrees=True) * front for angle in (0, 90, 180, 270)]
    return [*around, Rotation.identity(), Rotation.from_euler("x", 180, degrees=True)]
