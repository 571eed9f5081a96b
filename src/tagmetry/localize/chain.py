"""The inverse chain: where the camera is as one marker alone has it.

    T_world_camera = T_world_marker T_marker_camera                       (seed 002, section 3.2)

with T_marker_camera the inverse of what `pose` measures. The covariance goes the same way: the
corners' through the inverse, the map's through the product.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, UncertainTransform
from tagmetry.localize.marker_map import MapMarker
from tagmetry.localize.result import CameraHypothesis
from tagmetry.localize.seen import SeenMarker
from tagmetry.pose import MarkerPose, PoseHypothesis, estimate_poses


@dataclass(frozen=True, eq=False)
class MarkerView:
    """One marker's own opinion of where the camera is.

    Attributes:
        seen: The marker of the map and its corners.
        hypotheses: T_world_camera, the likelier first; one or two.
        distance_m: From the camera to the marker, by the likelier.
    """

    seen: SeenMarker
    hypotheses: tuple[CameraHypothesis, ...]
    distance_m: float

    @property
    def marker(self) -> MapMarker:
        """The marker of the map."""
        return self.seen.marker

    @property
    def best(self) -> CameraHypothesis:
        """The likelier hypothesis."""
        return self.hypotheses[0]

    @property
    def expected_error2_m2(self) -> float:
        """Expected squared error of the likelier position, a flip included, m^2."""
        own = float(np.trace(self.best.covariance[:3, :3]))
        return own + sum(
            other.probability * _distance2_m2(self.best, other) for other in self.hypotheses[1:]
        )


def marker_views(seen: Sequence[SeenMarker], camera: Camera) -> tuple[MarkerView, ...]:
    """Return each marker's own opinion; a marker whose corners allow no pose has none."""
    poses = estimate_poses(
        [one.detection for one in seen], camera, [one.marker.size_m for one in seen]
    )
    return tuple(_view(one, pose) for one, pose in zip(seen, poses, strict=True) if pose.hypotheses)


def _view(seen: SeenMarker, pose: MarkerPose) -> MarkerView:
    hypotheses = [
        _hypothesis(seen.marker.uncertain @ one.uncertain.inverse(), one, seen.marker)
        for one in pose.hypotheses
    ]
    distance_m = float(np.linalg.norm(pose.best.T_camera_marker.translation))
    return MarkerView(seen, tuple(hypotheses), distance_m)


def _hypothesis(
    world_camera: UncertainTransform, found: PoseHypothesis, marker: MapMarker
) -> CameraHypothesis:
    T, covariance = world_camera.T_a_b, world_camera.covariance
    return CameraHypothesis(T, covariance, found.probability, (marker.key,), (), found.chi2, 2)


def positions_m(views: Sequence[MarkerView]) -> Array:
    """Return the likelier camera positions in the world, shape (n, 3)."""
    return np.array([view.best.T_world_camera.translation for view in views])


def _distance2_m2(one: CameraHypothesis, other: CameraHypothesis) -> float:
    apart = one.T_world_camera.translation - other.T_world_camera.translation
    return float(apart @ apart)
