"""Markers as a camera sees them, with noise of a known covariance."""

import numpy as np

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MarkerBody, MountedMarker, marker_corners_m

FACING = Rotation.from_euler("x", 180, degrees=True)  # upright, seen straight on
PINHOLE = Camera(1280, 960, (1000.0, 1000.0), (639.5, 479.5))
DISTORTED = Camera(
    *(1280, 960, (1010.0, 990.0), (650.0, 470.0)), BrownLens((-0.25, 0.09, 0.001, -0.002, -0.01))
)
FISHEYE = Camera(
    1280, 960, (420.0, 421.0), (642.0, 477.0), FisheyeLens((0.03, -0.01, 0.002, -4e-4))
)


def facing(tilt_deg: float = 0.0, across_deg: float = 0.0, roll_deg: float = 0.0) -> Rotation:
    """Return R_camera_marker: rolled, then tilted about an axis of the image."""
    axis = np.array([np.cos(np.deg2rad(across_deg)), np.sin(np.deg2rad(across_deg)), 0.0])
    return (
        Rotation.from_rotvec(np.deg2rad(tilt_deg) * axis)
        * FACING
        * Rotation.from_euler("z", roll_deg, degrees=True)
    )


def posed(rotation: Rotation, x_m: float, y_m: float, z_m: float) -> RigidTransform:
    return RigidTransform.from_components([x_m, y_m, z_m], rotation)


def corners_seen(camera: Camera, T_camera_marker: RigidTransform, size_m: float) -> Array:
    return camera.project(T_camera_marker.apply(marker_corners_m(size_m)))


def detection(
    corners_px: Array,
    covariance_px2: Array | float = 0.01,
    name: str = "tag36h11",
    marker_id: int = 0,
) -> Detection:
    covariance = np.eye(8) * covariance_px2 if np.isscalar(covariance_px2) else covariance_px2
    return Detection(name, marker_id, np.asarray(corners_px), np.asarray(covariance), 0, 1.0)


def correlated_px2(sd_px: float) -> Array:
    """Return a full covariance: anisotropic, correlated, on average about sd_px^2."""
    mix = np.random.default_rng(7).normal(size=(8, 8))
    covariance = mix @ mix.T / 8 + np.diag(np.linspace(0.1, 1.0, 8))
    return np.asarray(covariance * sd_px**2 * 8 / np.trace(covariance))


def flat_board(columns: int = 3, rows: int = 2, size_m: float = 0.05) -> MarkerBody:
    step_m = 1.4 * size_m
    return MarkerBody(
        "board",
        tuple(
            MountedMarker(
                "tag36h11",
                column + columns * row,
                size_m,
                RigidTransform.from_translation([column * step_m, row * step_m, 0.0]),
            )
            for row in range(rows)
            for column in range(columns)
        ),
    )


def body_seen(
    body: MarkerBody,
    camera: Camera,
    T_camera_body: RigidTransform,
    covariance_px2: Array,
    rng: np.random.Generator,
) -> list[Detection]:
    """Return the markers of a body that face the camera, with noise."""
    seen = []
    for marker in body.markers:
        T_camera_marker = T_camera_body * marker.T_body_marker
        if T_camera_marker.rotation.as_matrix()[:, 2] @ T_camera_marker.translation < 0:
            noise = rng.multivariate_normal(np.zeros(8), covariance_px2).reshape(4, 2)
            corners = corners_seen(camera, T_camera_marker, marker.size_m) + noise
            seen.append(detection(corners, covariance_px2, marker.family, marker.id))
    return seen
