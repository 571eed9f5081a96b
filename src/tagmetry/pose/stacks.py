"""Many sightings and many poses at once, as plain arrays, to be worked on together."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray
from tagmetry.geometry.transforms import Rotation

Rows = slice | BoolArray | NDArray[np.intp]


@dataclass(frozen=True)
class Sightings:
    """What was seen of n bodies, k points each.

    Attributes:
        p_body: The points in the body's frame, shape (n, k, 3), metres.
        pixels: Where they were seen, shape (n, k, 2).
        whitening: W with W C W^T = I, shape (n, 2k, 2k), 1 / px.
    """

    p_body: Array
    pixels: Array
    whitening: Array

    def __getitem__(self, chosen: Rows) -> "Sightings":
        """Return some of the sightings."""
        return Sightings(self.p_body[chosen], self.pixels[chosen], self.whitening[chosen])

    def repeated(self, times: int) -> "Sightings":
        """Return every sighting several times in a row."""
        parts = (self.p_body, self.pixels, self.whitening)
        return Sightings(*(np.repeat(part, times, axis=0) for part in parts))


@dataclass(frozen=True)
class Poses:
    """n poses: `p_camera = R_camera_body @ p_body + t_camera_body`.

    Attributes:
        R_camera_body: Shape (n, 3, 3).
        t_camera_body: Shape (n, 3), metres.
    """

    R_camera_body: Array
    t_camera_body: Array

    def __getitem__(self, chosen: Rows) -> "Poses":
        """Return some of the poses."""
        return Poses(self.R_camera_body[chosen], self.t_camera_body[chosen])

    @classmethod
    def of(cls, Ts_camera_body: RigidTransform) -> "Poses":
        """Return n rigid transforms as plain arrays."""
        return cls(Ts_camera_body.rotation.as_matrix(), np.asarray(Ts_camera_body.translation))

    def turns_rad(self, other: "Poses") -> Array:
        """Return the angles between these n rotations and others (n or 1), shape (n,)."""
        chord = np.linalg.norm(self.R_camera_body - other.R_camera_body, axis=(1, 2))
        return np.asarray(2 * np.arcsin(np.minimum(chord / np.sqrt(8), 1.0)))

    def transforms(self) -> RigidTransform:
        """Return the n poses as rigid transforms."""
        rotations = Rotation.from_matrix(self.R_camera_body)
        return RigidTransform.from_components(self.t_camera_body, rotations)

    def moved(self, change: Array) -> "Poses":
        """Return the poses after small changes, shape (n, 6)."""
        turn = Rotation.from_rotvec(change[:, 3:]).as_matrix()
        return Poses(turn @ self.R_camera_body, self.t_camera_body + change[:, :3])

    def change_to(self, other: "Poses") -> Array:
        """Return the changes that lead to other poses, shape (n, 6): the inverse of `moved`."""
        turn = Rotation.from_matrix(other.R_camera_body @ np.swapaxes(self.R_camera_body, 1, 2))
        return np.hstack([other.t_camera_body - self.t_camera_body, turn.as_rotvec()])

    def points(self, p_body: Array) -> Array:
        """Return points (n, k, 3) in the camera frame."""
        turned = p_body @ np.swapaxes(self.R_camera_body, 1, 2)
        return np.asarray(turned + self.t_camera_body[:, None])
