"""The world from floor markers that lie anywhere: no ruler, only their sizes.

All corners of all floor markers are explained at once by the camera's pose (6 numbers) and each
marker's (x, y, direction) on the plane z = 0. The world's origin is the centre of one marker, and
its x axis points to the centre of a second one, or, with none, to the right of the first. That
takes three numbers away.

Every marker's own plane is a first guess of the floor; the one that explains all others best is
led to the solution. The markers' sizes give the scale.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena.floor_solution import RIGHT_RAD, FloorMarkersSeen, FloorSolution, lying
from tagmetry.arena.on_plane import OverheadView
from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import IntArray
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey
from tagmetry.pose import estimate_poses


@dataclass(frozen=True, eq=False)
class LaidFloor:
    """The floor as one picture tells it.

    Attributes:
        floor: The markers at their places, with covariances in the world frame.
        view: The camera at its place.
        chi2: Of all corners.
        freedom: Degrees of freedom of that.
    """

    floor: MarkerMap
    view: OverheadView
    chi2: float
    freedom: int


def lay_floor(
    detections: Sequence[Detection],
    sizes_m: Sequence[float],
    camera: Camera,
    origin: MarkerKey,
    toward: MarkerKey | None = None,
) -> LaidFloor:
    """Return the floor markers' places and the camera's.

    Args:
        detections: The floor markers of one image, each once.
        sizes_m: Side of each one's black square, in their order.
        camera: Intrinsics of the image.
        origin: The marker whose centre is the world's origin.
        toward: The marker to whose centre the world's x axis points; to the right of the origin's
            marker when None.

    Raises:
        InputError: One of the two markers is not among them, or no plane explains the corners.
    """
    keys = [MarkerKey(one.family, one.id) for one in detections]
    if len(set(keys)) < len(keys):
        raise InputError("a floor marker was seen twice; every one has an id of its own")
    first = _number(origin, keys, "origin")
    second = _number(toward, keys, "x axis") if toward is not None else None
    if second == first:
        raise InputError("the x axis needs another marker than the origin")
    seen = FloorMarkersSeen.of(detections, np.array(sizes_m, dtype=np.float64))
    start = _started(detections, seen, camera, first, second)
    free = _free(len(keys), first, second)
    return _laid(FloorSolution(*start, seen, free).solved, keys)


def _number(key: MarkerKey, keys: Sequence[MarkerKey], what: str) -> int:
    if key not in keys:
        seen = ", ".join(str(one.id) for one in keys) or "none"
        raise InputError(
            f"the {what}'s floor marker {key.family} id {key.id} is not seen; of the floor's "
            f"markers there are {seen}"
        )
    return keys.index(key)


def _started(
    detections: Sequence[Detection],
    seen: FloorMarkersSeen,
    camera: Camera,
    first: int,
    second: int | None,
) -> tuple[OverheadView, Array]:
    """Return the view and the places, in the world's frame, that one marker's plane gives."""
    poses = estimate_poses(list(detections), camera, seen.sizes_m.tolist())
    views = [
        OverheadView(camera, one.T_camera_marker.inv(), np.zeros((6, 6)))
        for pose in poses
        for one in pose.hypotheses
    ]
    rated = [(seen.fits(view), view) for view in views]
    (places, chi2), view = min(rated, key=lambda one: one[0][1], default=((None, np.inf), None))
    if view is None or places is None or not np.isfinite(chi2):
        raise InputError("the markers' corners are not those of markers on one floor")
    T_world_plane = _world_of(places, first, second)
    T_world_camera = T_world_plane * view.T_world_camera
    moved = OverheadView(camera, T_world_camera, view.covariance)
    return moved, seen.fits(moved)[0]


def _world_of(places: Array, first: int, second: int | None) -> RigidTransform:
    """Return T_world_plane of the gauge."""
    origin = places[first]
    x_axis = origin[2] - RIGHT_RAD
    if second is not None:
        x_axis = np.arctan2(*(places[second] - origin)[1::-1])
    turn = Rotation.from_euler("z", -x_axis)
    at = turn.apply([*origin[:2], 0.0])
    return RigidTransform.from_components(-at, turn)


def _free(count: int, first: int, second: int | None) -> IntArray:
    """Return which of the 3 n numbers of the places are free: not those of the gauge."""
    fixed = [3 * first, 3 * first + 1, 3 * first + 2 if second is None else 3 * second + 1]
    return np.setdiff1d(np.arange(3 * count), fixed)


def _laid(state: FloorSolution, keys: Sequence[MarkerKey]) -> LaidFloor:
    """Return the solution with its covariances; corners that fit badly make them larger."""
    residuals, by_asked = state.equations
    freedom = len(residuals) - by_asked.shape[1]
    covariance = max(1.0, state.chi2 / freedom) * np.linalg.inv(by_asked.T @ by_asked)
    of_places = np.zeros((3 * len(keys),) * 2)
    of_places[np.ix_(state.free, state.free)] = covariance[6:, 6:]
    sizes_m = state.seen.sizes_m.tolist()
    markers = tuple(
        _map_marker(key, sizes_m[n], state.places[n], of_places[3 * n :, 3 * n :][:3, :3])
        for n, key in enumerate(keys)
    )
    view = OverheadView(state.view.camera, state.view.T_world_camera, covariance[:6, :6])
    return LaidFloor(MarkerMap(markers, "floor"), view, state.chi2, freedom)


def _map_marker(key: MarkerKey, size_m: float, place: Array, covariance: Array) -> MapMarker:
    rows = np.ix_([0, 1, 5], [0, 1, 5])
    of_pose = np.zeros((6, 6))
    of_pose[rows] = (covariance + covariance.T) / 2
    return MapMarker(key.family, key.id, size_m, lying(place), of_pose)
