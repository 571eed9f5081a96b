"""What the formats of marker maps have in common: poses, checked, and what a file leaves out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.checked import FileModel
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation

_UNIT = 1e-3  # by how much a quaternion's length or a matrix's product may be off


@dataclass(frozen=True)
class MapDefaults:
    """What is taken where a map's file does not say it.

    Attributes:
        family: Family of its markers.
        size_m: Side of their black squares: one for all, or by id.
    """

    family: str | None = None
    size_m: float | Mapping[int, float] | None = None

    def family_of(self, marker_id: int, stated: str | None) -> str:
        """Return a marker's family: the stated one, else the default."""
        family = stated if stated is not None else self.family
        if family is None:
            raise InputError(
                f"the file does not say of which family id {marker_id} is; name it (--family)"
            )
        return family

    def size_of(self, marker_id: int, stated_m: float | None) -> float:
        """Return a marker's size in metres: the stated one, else the default."""
        if stated_m is not None:
            return stated_m
        by_id = self.size_m
        size_m = by_id.get(marker_id) if isinstance(by_id, Mapping) else by_id
        if size_m is None:
            raise InputError(
                f"the file does not say how large id {marker_id} is; give the side of its black "
                "square (--size)"
            )
        return size_m


class Vector(FileModel):
    """Three numbers under x, y and z."""

    x: float
    y: float
    z: float

    @property
    def array(self) -> Array:
        """Shape (3,)."""
        return np.array([self.x, self.y, self.z])


def vector_table(values: Sequence[float] | Array) -> dict[str, Any]:
    """Return three numbers as `Vector` reads them."""
    return {key: float(value) for key, value in zip("xyz", values, strict=True)}


def pose_of(translation_m: Array, quaternion_xyzw: Sequence[float]) -> RigidTransform:
    """Return the pose of a translation and a quaternion, which must have length one."""
    length = float(np.linalg.norm(quaternion_xyzw))
    if abs(length - 1) > _UNIT:
        raise InputError(
            f"expected a quaternion of length 1, found {list(quaternion_xyzw)} of length "
            f"{length:.4g}; it is given as x, y, z, w"
        )
    return RigidTransform.from_components(translation_m, Rotation.from_quat(quaternion_xyzw))


def rotation_of(matrix: Array) -> Rotation:
    """Return the rotation of a matrix (3, 3); a left-handed or a stretched one is refused."""
    if not np.allclose(matrix @ matrix.T, np.eye(3), atol=_UNIT):
        raise InputError(f"expected a rotation matrix, found {matrix.tolist()}: no unit axes")
    if np.linalg.det(matrix) < 0:
        raise InputError(
            f"the rotation {matrix.tolist()} is left-handed: it mirrors; negate one axis, z comes "
            "out of the marker's face, x is its right and y its top"
        )
    return Rotation.from_matrix(matrix)


def quaternion_xyzw(T_a_b: RigidTransform) -> list[float]:
    """Return the rotation as a unit quaternion with w not negative."""
    numbers: list[float] = (T_a_b.rotation.as_quat(canonical=True) + 0.0).tolist()
    return numbers


def local_deviations(covariance: Array, T_a_b: RigidTransform) -> tuple[Array, Array]:
    """Return standard deviations along the axes of frame b: metres (3,) and rad (3,)."""
    turn = np.kron(np.eye(2), T_a_b.rotation.as_matrix().T)
    deviations = np.sqrt(np.maximum(np.diag(turn @ covariance @ turn.T), 0.0))
    return deviations[:3], deviations[3:]


def covariance_of(position_m: Array, rotation_rad: Array, T_a_b: RigidTransform) -> Array:
    """Return the covariance in frame a of deviations along the axes of frame b."""
    turn = np.kron(np.eye(2), T_a_b.rotation.as_matrix())
    return np.asarray(turn @ np.diag(np.concatenate([position_m, rotation_rad]) ** 2) @ turn.T)
