"""From a walk to what the page is told.

Frames: p_world = T_world_camera @ p_camera; the covariance of a pose is on the left, in the world.
"""

import numpy as np

from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform
from tagmetry.live.rooms.locate.looked import Looked
from tagmetry.live.rooms.locate.messages import LocateMarker, LocatePoint, LocateResidual
from tagmetry.live.show.told import ellipse_of
from tagmetry.localize import CameraHypothesis, MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey


def told_marker(one: MapMarker) -> LocateMarker:
    """Return a marker as it is seen from above: its left and right end."""
    ends = one.T_world_marker.apply(one.size_m / 2 * np.array([[-1.0, 0, 0], [1, 0, 0]]))
    (left_x, left_y, _), (right_x, right_y, _) = ends.tolist()
    return LocateMarker(one.id, (left_x, left_y), (right_x, right_y))


def told_point(looked: Looked, best: CameraHypothesis) -> LocatePoint:
    """Return where the camera says it was, and where it was if that is known."""
    T, covariance = best.T_world_camera, best.covariance
    x_m, y_m, z_m = np.asarray(T.translation).tolist()
    ahead = T.rotation.as_matrix()[:, 2]
    sd = np.sqrt(np.diag(covariance)).tolist()
    true = looked.T_world_camera
    return LocatePoint(
        x_m,
        y_m,
        z_m,
        float(np.arctan2(ahead[1], ahead[0])),
        ellipse_of(covariance[:2, :2]),
        (sd[0], sd[1], sd[2]),
        (sd[3], sd[4], sd[5]),
        None if true is None else _place(true),
        None if true is None else _mahalanobis2(T, true, covariance),
    )


def told_residuals(
    looked: Looked, best: CameraHypothesis, marker_map: MarkerMap
) -> tuple[LocateResidual, ...]:
    """Return what every marker of an image that stands in the map says of the pose."""
    known = {one.key: one for one in marker_map.markers}
    reasons = {one.key: one.why for one in (*best.rejected, *looked.pose.passed_over)}
    keys = [MarkerKey(one.family, one.id) for one in looked.detections]
    return tuple(
        _residual(looked, best, seen, known[key], reasons.get(key, ""))
        for key, seen in zip(keys, looked.detections, strict=True)
        if key in known
    )


def _residual(
    looked: Looked, best: CameraHypothesis, seen: Detection, known: MapMarker, why: str
) -> LocateResidual:
    T_camera_marker = best.T_world_camera.inv() * known.T_world_marker
    half_m = known.size_m / 2
    corners_m = half_m * np.array([[-1.0, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]])
    apart_px = looked.camera.project(T_camera_marker.apply(corners_m)) - seen.corners_px
    distance_m = float(np.linalg.norm(T_camera_marker.translation))
    rms_px = float(np.sqrt((apart_px**2).sum(axis=1).mean()))
    return LocateResidual(seen.id, distance_m, rms_px, known.key in best.used, why)


def _place(T: RigidTransform) -> tuple[float, float, float]:
    x_m, y_m, z_m = np.asarray(T.translation).tolist()
    return x_m, y_m, z_m


def _mahalanobis2(found: RigidTransform, true: RigidTransform, covariance: Array) -> float:
    """Return the squared error of a pose by its covariance."""
    moved = np.asarray(true.translation) - np.asarray(found.translation)
    turned = (true.rotation * found.rotation.inv()).as_rotvec()
    error = np.concatenate([moved, turned])
    return float(error @ np.linalg.solve(covariance, error))
