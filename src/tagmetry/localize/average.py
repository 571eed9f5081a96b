"""Averages of what single markers say: the plain one of seed 004, the weighted one of seed 002.

Seed 002, section 3.3: `ratio_i = weight_i / weight_total`, and

    [x, y, z] = sum([x_i, y_i, z_i] ratio_i)
    angle     = atan2(sum(sin(angle_i) ratio_i), sum(cos(angle_i) ratio_i))

for each of the three angles. The paper prints atan of the quotient, which loses two quadrants. "The
closer the marker is, the bigger is the weight" is made 1 / distance^power. An average heeds neither
how sure a marker is nor that one may be wrong: it is here to be compared with.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, mean_angle_rad, mean_rotation
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize.chain import MarkerView, marker_views, positions_m
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.result import CameraHypothesis
from tagmetry.localize.seen import SeenMarker

Angles = Literal["euler", "group"]


@dataclass(frozen=True)
class MeanOfMarkers:
    """The plain average of all markers' likelier poses (seed 004)."""

    name: str = "mean"
    heeds_knowledge: bool = False

    def hypotheses(
        self,
        seen: Sequence[SeenMarker],
        camera: Camera,
        known: Knowledge,  # noqa: ARG002
    ) -> tuple[CameraHypothesis, ...]:
        """Return one pose, or none where no marker has one."""
        views = marker_views(seen, camera)
        return _averaged(views, np.ones(len(views)), "group")


@dataclass(frozen=True)
class WeightedByDistance:
    """The average of all markers' likelier poses, nearer ones weighing more (seed 002).

    Attributes:
        power: The weight is 1 / distance^power.
        angles: `euler` averages yaw, pitch and roll one by one, as the paper does; `group` averages
            the rotations.
    """

    power: float = 1.0
    angles: Angles = "euler"
    name: str = "weighted"
    heeds_knowledge: bool = False

    def __post_init__(self) -> None:
        if not 0 <= self.power <= 10:
            raise InputError(f"power must be from 0 to 10, got {self.power}")
        if self.angles not in ("euler", "group"):
            raise InputError(f"angles must be euler or group, got {self.angles!r}")

    def hypotheses(
        self,
        seen: Sequence[SeenMarker],
        camera: Camera,
        known: Knowledge,  # noqa: ARG002
    ) -> tuple[CameraHypothesis, ...]:
        """Return one pose, or none where no marker has one."""
        views = marker_views(seen, camera)
        weights = np.array([view.distance_m for view in views]) ** -self.power
        return _averaged(views, weights, self.angles)


def _averaged(
    views: Sequence[MarkerView], weights: Array, angles: Angles
) -> tuple[CameraHypothesis, ...]:
    if not views:
        return ()
    ratios = weights / weights.sum()
    rotations = Rotation.concatenate([view.best.T_world_camera.rotation for view in views])
    rotation = (
        mean_rotation(rotations, ratios) if angles == "group" else _mean_euler(rotations, ratios)
    )
    T = RigidTransform.from_components(ratios @ positions_m(views), rotation)
    covariance = sum(
        ratio**2 * view.best.covariance for ratio, view in zip(ratios, views, strict=True)
    )
    none_is_flipped = float(np.prod([view.best.probability for view in views]))
    used = tuple(view.marker.key for view in views)
    return (CameraHypothesis(T, np.asarray(covariance), none_is_flipped, used),)


def _mean_euler(rotations: Rotation, ratios: Array) -> Rotation:
    """Return the rotation of the mean yaw, pitch and roll, about z, then y, then x."""
    angles_rad = rotations.as_euler("ZYX").reshape(-1, 3)
    return Rotation.from_euler("ZYX", [mean_angle_rad(column, ratios) for column in angles_rad.T])
