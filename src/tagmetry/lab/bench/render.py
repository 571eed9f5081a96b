"""Rendered cases: markers in rows before a background, exactly known.

The markers are tilted up to 35 degrees about two axes and turned about the third at random. In a
film each swings round its place, so that its end joins its beginning.
"""

from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.bench.case import Case, Truth, nothing
from tagmetry.lab.bench.clutter import clutter_light
from tagmetry.lab.bench.setup import SIZE_M, Setup
from tagmetry.lab.bench.stage import Stage, drawn_motion_px, photographed, seen_on
from tagmetry.markers import MountedMarker
from tagmetry.markers import family as family_of

_BACKGROUND = 0.45  # radiance, of full scale
_MOST_TILT_DEG = 35.0
_SWING_PX, _SWING_DEG = 6.0, 3.0  # of 12 images: 3 px an image, and 1.6 px off a straight path


def rendered(setup: Setup, family: str, seed: int = 0) -> Case:
    """Return a case with its images, always the same ones.

    Args:
        setup: What to render.
        family: Family of the markers.
        seed: Of places, background and noise.
    """
    rng = np.random.default_rng([seed, *setup.name.encode()])
    camera, behind = _camera(setup), _behind(setup, seed)
    films = _films(setup, camera, family, rng)
    stage = Stage(setup, camera, behind, drawn_motion_px(setup, rng))
    return Case(
        setup.name,
        family,
        tuple(photographed(stage, markers, rng) for markers in films),
        tuple(_truth(markers, camera) for markers in films),
        seen_on(stage),
        setup.is_standard,
        setup.is_film,
        setup.images > 1 and not setup.is_film,
    )


def _camera(setup: Setup) -> Camera:
    width_px, height_px = setup.size_px
    middle_px = ((width_px - 1) / 2, (height_px - 1) / 2)
    return Camera(width_px, height_px, (float(width_px), float(width_px)), middle_px)


def _behind(setup: Setup, seed: int) -> FloatImage:
    """Return the light behind the markers, blurred as the camera does."""
    if not setup.cluttered:
        return np.full(setup.size_px[::-1], _BACKGROUND, np.float32)
    sharp = clutter_light(setup.size_px, seed)
    return np.asarray(cv2.GaussianBlur(sharp, (0, 0), setup.blur_px), np.float32)


def _truth(markers: Sequence[MountedMarker], camera: Camera) -> Truth:
    if not markers:
        return nothing(1)[0]
    return Truth(
        np.array([marker.id for marker in markers]),
        np.stack([camera.project(marker.corners_m) for marker in markers]),
        RigidTransform.concatenate([marker.T_body_marker for marker in markers]),
    )


def _films(
    setup: Setup, camera: Camera, family: str, rng: np.random.Generator
) -> list[list[MountedMarker]]:
    """Return the markers of every image, at their poses in the camera."""
    depth_m = SIZE_M * setup.size_px[0] / setup.side_px
    paths = [_poses(setup, camera, n, depth_m, rng) for n in range(setup.count)]
    others = 0 if setup.is_film else setup.count
    return [
        [
            MountedMarker(family, (k * others + n) % len(family_of(family)), SIZE_M, path[k])
            for n, path in enumerate(paths)
        ]
        for k in range(setup.images)
    ]


def _poses(
    setup: Setup, camera: Camera, n: int, depth_m: float, rng: np.random.Generator
) -> list[RigidTransform]:
    """Return T_camera_marker of the nth marker in every image."""
    at_px = _place_px(setup, n)
    if setup.is_film:
        return _round(setup, camera, at_px, depth_m, rng)
    still = replace(setup, images=1)
    return [
        pose for _ in range(setup.images) for pose in _round(still, camera, at_px, depth_m, rng)
    ]


def _round(
    setup: Setup, camera: Camera, at_px: Array, depth_m: float, rng: np.random.Generator
) -> list[RigidTransform]:
    """Return T_camera_marker of a marker in every image of a film."""
    turn_deg, tilt_deg, lean_deg = _angles_deg(setup, rng)
    phase_rad = rng.uniform(0, 2 * np.pi)
    poses = []
    for k in range(setup.images):
        swing = _swing(setup, 2 * np.pi * k / setup.images + phase_rad)
        ray = camera.unproject(at_px + _SWING_PX * swing)
        angles = [180 + tilt_deg, lean_deg, turn_deg + _SWING_DEG * swing[0]]
        R_camera_marker = _R_camera_sight(setup, ray) * Rotation.from_euler(
            "xyz", angles, degrees=True
        )
        poses.append(RigidTransform.from_components(ray / ray[2] * depth_m, R_camera_marker))
    return poses


def _angles_deg(setup: Setup, rng: np.random.Generator) -> Array:
    """Return how a marker leans about x and y, and is turned about z: (about z, x, y)."""
    drawn = rng.uniform(-1, 1, 3)
    if setup.tilt_deg is None:
        return np.asarray(drawn * [180, _MOST_TILT_DEG, _MOST_TILT_DEG])
    tilt_rad, to_side_rad = np.radians(setup.tilt_deg), np.pi * drawn[1]
    about_x = np.arcsin(np.sin(tilt_rad) * np.cos(to_side_rad))
    about_y = np.arctan2(np.sin(tilt_rad) * np.sin(to_side_rad), np.cos(tilt_rad))
    return np.array([180 * drawn[0], np.degrees(about_x), np.degrees(about_y)])


def _R_camera_sight(setup: Setup, ray: Array) -> Rotation:  # noqa: N802 (frames)
    """Return the frame that a marker leans in: the camera's, or that of its line of sight."""
    if setup.tilt_deg is None:
        return Rotation.identity()
    axis = np.cross([0.0, 0.0, 1.0], ray)
    angle_rad = np.arccos(np.clip(ray[2], -1, 1))
    return Rotation.from_rotvec(angle_rad * axis / max(np.linalg.norm(axis), 1e-12))


def _swing(setup: Setup, phase_rad: float) -> Array:
    """Return where on its round a marker is; one of a single image stands still."""
    round_ = np.array([np.cos(phase_rad), np.sin(phase_rad)])
    return round_ if setup.is_film else np.zeros(2)


def _place_px(setup: Setup, n: int) -> Array:
    """Return the middle of the nth of as many equal fields as there are markers."""
    width_px, height_px = setup.size_px
    columns = int(np.ceil(np.sqrt(setup.count * width_px / height_px)))
    rows = -(-setup.count // columns)
    row, column = divmod(n, columns)
    return np.array([(column + 0.5) * width_px / columns, (row + 0.5) * height_px / rows]) - 0.5
