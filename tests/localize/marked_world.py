"""A world of markers, and what a camera sees of it with noise of a known covariance."""

import numpy as np

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform, perturb_pose
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers import marker_corners_m

VGA = Camera(640, 480, (600.0, 600.0), (319.5, 239.5))
DISTORTED = Camera(
    *(1280, 960, (1010.0, 990.0), (650.0, 470.0)), BrownLens((-0.25, 0.09, 0.001, -0.002, -0.01))
)
FISHEYE = Camera(
    1280, 960, (420.0, 421.0), (642.0, 477.0), FisheyeLens((0.03, -0.01, 0.002, -4e-4))
)
UPRIGHT = Rotation.from_matrix([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])  # R_world_camera: looks along x
ON_WALL = Rotation.from_matrix([[0, 0, -1], [-1, 0, 0], [0, 1, 0]])  # R_world_marker: faces -x


def camera_at(x_m: float, y_m: float, z_m: float, turn_deg=(0.0, 0.0, 0.0)) -> RigidTransform:
    """Return T_world_camera: level, looking along x, then turned about the world's z, y, x."""
    turn = Rotation.from_euler("ZYX", turn_deg, degrees=True)
    return RigidTransform.from_components([x_m, y_m, z_m], turn * UPRIGHT)


def wall_marker(
    marker_id: int,
    y_m: float,
    z_m: float,
    *,
    x_m: float = 0.0,
    size_m: float = 0.16,
    lean=(0, 0, 0),
) -> MapMarker:
    """Return a marker on the wall x = x_m, facing -x, then turned about the world's z, y, x."""
    turn = Rotation.from_euler("ZYX", lean, degrees=True)
    T = RigidTransform.from_components([x_m, y_m, z_m], turn * ON_WALL)
    return MapMarker("tag36h11", marker_id, size_m, T)


def wall(columns: int = 3, rows: int = 2, step_m: float = 0.5, size_m: float = 0.16) -> MarkerMap:
    """Return markers in one plane around the origin, 1.2 m high."""
    return MarkerMap(
        tuple(
            wall_marker(
                column + columns * row,
                (column - (columns - 1) / 2) * step_m,
                1.2 + (row - (rows - 1) / 2) * step_m,
                size_m=size_m,
            )
            for row in range(rows)
            for column in range(columns)
        )
    )


def room() -> MarkerMap:
    """Return ten markers on walls that face each other's way by up to 60 degrees."""
    markers = [
        wall_marker(
            n,
            -1.5 + n / 3,
            1.0 + 0.3 * (n % 3),
            x_m=0.2 * (n % 2),
            lean=(25 * ((n % 5) - 2), 15 * ((n % 3) - 1), 10 * n),
        )
        for n in range(10)
    ]
    return MarkerMap(tuple(markers))


def seen_by(
    camera: Camera,
    T_world_camera: RigidTransform,
    marker_map: MarkerMap,
    noise_px: float = 0.3,
    rng: np.random.Generator | None = None,
) -> list[Detection]:
    """Return the markers that face the camera and lie in its image; exact without a generator."""
    found = []
    for marker in marker_map.markers:
        p_camera = T_world_camera.inv().apply(
            marker.T_world_marker.apply(marker_corners_m(marker.size_m))
        )
        T_camera_marker = T_world_camera.inv() * marker.T_world_marker
        faces = T_camera_marker.rotation.as_matrix()[:, 2] @ T_camera_marker.translation < 0
        corners_px = camera.project(p_camera)
        if faces and camera.contains(corners_px).all():
            noise = rng.normal(size=(4, 2)) * noise_px if rng is not None else 0.0
            found.append(detection(marker, corners_px + noise, noise_px))
    return found


def detection(marker: MapMarker, corners_px: Array, noise_px: float) -> Detection:
    return Detection(marker.family, marker.id, corners_px, np.eye(8) * noise_px**2, 0, 1.0)


def surveyed(marker_map: MarkerMap, covariance: Array, rng: np.random.Generator) -> MarkerMap:
    """Return the map as a survey of this covariance might have it."""
    markers = []
    for one in marker_map.markers:
        error = rng.multivariate_normal(np.zeros(6), covariance)
        T = perturb_pose(one.T_world_marker, error)
        markers.append(MapMarker(one.family, one.id, one.size_m, T, covariance, one.body))
    return MarkerMap(tuple(markers))
