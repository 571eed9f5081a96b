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
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag

from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.square_fit import fit_squares
from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform, perturb_pose
from tagmetry.geometry.arrays import IntArray
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey, marker_corners_m
from tagmetry.pose import estimate_poses

_MOST_STEPS = 50
_FIRST_DAMPING, _LARGEST_DAMPING = 1e-6, 1e6
_LEAST_GAIN = 1e-9  # of chi2
_RIGHT = np.pi / 2  # direction of a marker's top whose right is the world's x


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
    corners = _Corners.of(detections, np.array(sizes_m, dtype=np.float64))
    start = _started(detections, corners, camera, first, second)
    return _solved(start, corners, keys, first, second)


@dataclass(frozen=True, eq=False)
class _Corners:
    """Corners (n, 4, 2), their covariances (n, 8, 8), whitening (n, 8, 8), and sizes (n,)."""

    corners_px: Array
    covariances_px2: Array
    whiten: Array
    sizes_m: Array

    @classmethod
    def of(cls, detections: Sequence[Detection], sizes_m: Array) -> "_Corners":
        corners_px = np.array([one.corners_px for one in detections])
        covariances = np.array([one.corners_cov_px2 for one in detections])
        whiten = np.linalg.inv(np.linalg.cholesky(covariances))
        return cls(corners_px, covariances, whiten, sizes_m)

    def fits(self, view: OverheadView) -> tuple[Array, float]:
        """Return the places on the floor that a view gives, (n, 3), and how badly they fit."""
        heights = np.zeros(len(self.sizes_m))
        found = fit_squares(view, self.corners_px, self.covariances_px2, self.sizes_m, heights)
        chi2 = float(found.chi2.sum())
        return found.places, chi2 if np.isfinite(found.places).all() else np.inf


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
    corners: _Corners,
    camera: Camera,
    first: int,
    second: int | None,
) -> tuple[OverheadView, Array]:
    """Return the view and the places, in the world's frame, that one marker's plane gives."""
    poses = estimate_poses(list(detections), camera, corners.sizes_m.tolist())
    views = [
        OverheadView(camera, one.T_camera_marker.inv(), np.zeros((6, 6)))
        for pose in poses
        for one in pose.hypotheses
    ]
    rated = [(corners.fits(view), view) for view in views]
    (places, chi2), view = min(rated, key=lambda one: one[0][1], default=((None, np.inf), None))
    if view is None or places is None or not np.isfinite(chi2):
        raise InputError("the markers' corners are not those of markers on one floor")
    T_world_plane = _world_of(places, first, second)
    T_world_camera = T_world_plane * view.T_world_camera
    moved = OverheadView(camera, T_world_camera, view.covariance)
    return moved, corners.fits(moved)[0]


def _world_of(places: Array, first: int, second: int | None) -> RigidTransform:
    """Return T_world_plane of the gauge."""
    origin = places[first]
    x_axis = origin[2] - _RIGHT
    if second is not None:
        x_axis = np.arctan2(*(places[second] - origin)[1::-1])
    turn = Rotation.from_euler("z", -x_axis)
    at = turn.apply([*origin[:2], 0.0])
    return RigidTransform.from_components(-at, turn)


def _free(count: int, first: int, second: int | None) -> IntArray:
    """Return which of the 3 n numbers of the places are free: not those of the gauge."""
    fixed = [3 * first, 3 * first + 1, 3 * first + 2 if second is None else 3 * second + 1]
    return np.setdiff1d(np.arange(3 * count), fixed)


def _solved(
    start: tuple[OverheadView, Array],
    corners: _Corners,
    keys: Sequence[MarkerKey],
    first: int,
    second: int | None,
) -> LaidFloor:
    """Return the least squares over all corners (Levenberg and Marquardt's)."""
    free = _free(len(keys), first, second)
    state = _State(*start, corners, free)
    damping = _FIRST_DAMPING
    for _ in range(_MOST_STEPS):
        after = state.stepped(damping)
        if not after.chi2 < state.chi2:
            damping *= 10
            if damping > _LARGEST_DAMPING:
                break
            continue
        is_done = state.chi2 - after.chi2 < _LEAST_GAIN
        state, damping = after, damping / 10
        if is_done:
            break
    return _laid(state, keys)


@dataclass(frozen=True, eq=False)
class _State:
    """A solution on the way: the camera, the places (n, 3), and which of those are free."""

    view: OverheadView
    places: Array
    corners: _Corners
    free: IntArray

    @cached_property
    def equations(self) -> tuple[Array, Array]:
        """Whitened residuals, shape (8 n,), and their derivatives by what is asked."""
        poses = [_pose(place) for place in self.places]
        sized = zip(poses, self.corners.sizes_m.tolist(), strict=True)
        p_world = np.array([T.apply(marker_corners_m(size_m)) for T, size_m in sized])
        pixels, by_point = self.view.project(p_world)
        arm = p_world[..., :2] - self.places[:, None, :2]
        by_turn = by_point[..., :2] @ np.stack([-arm[..., 1], arm[..., 0]], -1)[..., None]
        by_place = np.concatenate([by_point[..., :2], by_turn], axis=-1).reshape(-1, 8, 3)
        by_camera = self.view.by_camera(p_world, by_point).reshape(-1, 8, 6)
        residuals = self.corners.whiten @ (self.corners.corners_px - pixels).reshape(-1, 8, 1)
        of_places = block_diag(*(self.corners.whiten @ by_place))[:, self.free]
        of_camera = (self.corners.whiten @ by_camera).reshape(-1, 6)
        return residuals.ravel(), np.hstack([of_camera, of_places])

    @property
    def chi2(self) -> float:
        """Of all corners."""
        residuals = self.equations[0]
        chi2 = float(residuals @ residuals)
        return chi2 if np.isfinite(chi2) else np.inf

    def stepped(self, damping: float) -> "_State":
        """Return the solution after a step."""
        residuals, by_asked = self.equations
        H = by_asked.T @ by_asked
        damped = H + damping * np.diag(np.diag(H))
        step: Array = np.asarray(np.linalg.solve(damped, by_asked.T @ residuals), dtype=np.float64)
        T = perturb_pose(self.view.T_world_camera, step[:6])
        places = self.places.ravel().copy()
        places[self.free] += step[6:]
        view = OverheadView(self.view.camera, T, self.view.covariance)
        return _State(view, places.reshape(-1, 3), self.corners, self.free)


def _laid(state: _State, keys: Sequence[MarkerKey]) -> LaidFloor:
    """Return the solution with its covariances; corners that fit badly make them larger."""
    residuals, by_asked = state.equations
    freedom = len(residuals) - by_asked.shape[1]
    covariance = max(1.0, state.chi2 / freedom) * np.linalg.inv(by_asked.T @ by_asked)
    of_places = np.zeros((3 * len(keys),) * 2)
    of_places[np.ix_(state.free, state.free)] = covariance[6:, 6:]
    sizes_m = state.corners.sizes_m.tolist()
    markers = tuple(
        _map_marker(key, sizes_m[n], state.places[n], of_places[3 * n :, 3 * n :][:3, :3])
        for n, key in enumerate(keys)
    )
    view = OverheadView(state.view.camera, state.view.T_world_camera, covariance[:6, :6])
    return LaidFloor(MarkerMap(markers, "floor"), view, state.chi2, freedom)


def _pose(place: Array) -> RigidTransform:
    """Return T_world_marker of a marker on the floor whose top points to a direction."""
    x_m, y_m, direction = place.tolist()
    return RigidTransform.from_components(
        [x_m, y_m, 0.0], Rotation.from_euler("z", direction - _RIGHT)
    )


def _map_marker(key: MarkerKey, size_m: float, place: Array, covariance: Array) -> MapMarker:
    rows = np.ix_([0, 1, 5], [0, 1, 5])
    of_pose = np.zeros((6, 6))
    of_pose[rows] = (covariance + covariance.T) / 2
    return MapMarker(key.family, key.id, size_m, _pose(place), of_pose)
