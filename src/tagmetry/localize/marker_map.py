"""The marker map: which markers stand where in the world, and how well that is known.

Frames: `world` is z up. `marker` has its origin at the centre, x to its right, y to its top, z out
of its face. `p_world = T_world_marker.apply(p_marker)`.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, UncertainTransform
from tagmetry.markers import MarkerBody, marker_corners_m
from tagmetry.markers.bodies import MarkerKey

LARGEST_SIZE_M = 20.0


@dataclass(frozen=True, eq=False)
class MapMarker:
    """A marker at its place in the world.

    Attributes:
        family: Name of its family.
        id: Its id.
        size_m: Side of its black square.
        T_world_marker: Where it is and how it is turned.
        covariance: How well that is known: shape (6, 6), (translation, rotation vector) on the
            left in the world frame, m and rad; zero where it is taken to be exact.
        body: Name of the rigid thing that it is mounted on, where there is one: the markers of one
            body have one error in common, all others each their own.
    """

    family: str
    id: int
    size_m: float
    T_world_marker: RigidTransform
    covariance: Array = field(default_factory=lambda: np.zeros((6, 6)))
    body: str | None = None

    def __post_init__(self) -> None:
        if not 0 < self.size_m <= LARGEST_SIZE_M:
            raise InputError(
                f"{self.label} has a size of {self.size_m} m; expected the side of its black "
                f"square in metres, above 0 and at most {LARGEST_SIZE_M:g}"
            )
        if self.id < 0:
            raise InputError(f"{self.label}: a marker's id is not negative")
        if not np.isfinite(self.T_world_marker.as_matrix()).all():
            raise InputError(f"{self.label} has a pose that is not finite")
        _check_covariance(self.label, self.covariance)

    @property
    def key(self) -> MarkerKey:
        """What tells it from the others."""
        return MarkerKey(self.family, self.id)

    @property
    def label(self) -> str:
        """Its name for people: `tag36h11 id 7`."""
        return f"{self.family} id {self.id}"

    @cached_property
    def p_world(self) -> Array:
        """Its corners in the world, clockwise from its top left, shape (4, 3), metres."""
        return np.asarray(self.T_world_marker.apply(marker_corners_m(self.size_m)))

    @cached_property
    def matrix(self) -> Array:
        """T_world_marker as a matrix, shape (4, 4)."""
        return np.asarray(self.T_world_marker.as_matrix())

    @cached_property
    def covariance_root(self) -> Array:
        """S with S S^T the covariance, shape (6, 6)."""
        variances, axes = np.linalg.eigh(self.covariance)
        return np.asarray(axes * np.sqrt(np.maximum(variances, 0.0)))

    @property
    def is_exact(self) -> bool:
        """Whether its place is taken to be known exactly."""
        return not self.covariance.any()

    @property
    def uncertain(self) -> UncertainTransform:
        """Its pose with its covariance, ready to be chained."""
        return UncertainTransform(self.T_world_marker, self.covariance)


@dataclass(frozen=True, eq=False)
class MarkerMap:
    """Markers whose places in the world are known.

    Attributes:
        markers: Each family and id once.
        name: What the place is called.
    """

    markers: tuple[MapMarker, ...]
    name: str = "map"

    def __post_init__(self) -> None:
        if not self.markers:
            raise InputError("a marker map needs at least one marker, got none")
        times = Counter(marker.key for marker in self.markers)
        if repeated := [key for key, count in times.items() if count > 1]:
            family, marker_id = min(repeated)
            raise InputError(
                f"the map has {family} id {marker_id} twice; a marker is named by its family and "
                "id and stands in one place"
            )

    @classmethod
    def of_body(cls, body: MarkerBody, world_body: UncertainTransform) -> Self:
        """Return the map of one body of markers.

        Args:
            body: The markers and their places on it.
            world_body: T_world_body with the covariance that its markers share.
        """
        markers = []
        for one in body.markers:
            world_marker = world_body @ UncertainTransform.exact(one.T_body_marker)
            T, covariance = world_marker.T_a_b, world_marker.covariance
            markers.append(MapMarker(one.family, one.id, one.size_m, T, covariance, body.name))
        return cls(tuple(markers), body.name)

    @cached_property
    def by_key(self) -> Mapping[MarkerKey, MapMarker]:
        """The markers by family and id."""
        return {marker.key: marker for marker in self.markers}

    @property
    def families(self) -> tuple[str, ...]:
        """The families that a detector has to look for, each once."""
        return tuple(dict.fromkeys(marker.family for marker in self.markers))

    def transformed(self, T_new_world: RigidTransform) -> "MarkerMap":
        """Return the same markers in another world frame."""
        to_new = UncertainTransform.exact(T_new_world)
        moved = [to_new @ marker.uncertain for marker in self.markers]
        markers = (
            replace(marker, T_world_marker=pose.T_a_b, covariance=pose.covariance)
            for marker, pose in zip(self.markers, moved, strict=True)
        )
        return MarkerMap(tuple(markers), self.name)


def _check_covariance(label: str, covariance: Array) -> None:
    """Refuse what is no covariance of a pose; rounding may make an eigenvalue a little negative."""
    if covariance.shape != (6, 6) or not np.isfinite(covariance).all():
        raise InputError(f"{label}: expected a finite 6x6 covariance, got {covariance.shape}")
    scale = float(np.abs(covariance).max())
    is_symmetric = np.allclose(covariance, covariance.T, rtol=1e-6, atol=1e-9 * scale)
    if not is_symmetric or np.linalg.eigvalsh(covariance)[0] < -1e-9 * scale:
        raise InputError(f"{label}: a covariance is symmetric and has no negative variance")
