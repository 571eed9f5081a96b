"""Rendered cases: markers in rows before a background, exactly known.

The markers are tilted up to 35 degrees about two axes and turned about the third at random. In a
film each swings round its place, so that its end joins its beginning.
"""

from collections.abc import Sequence

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage, GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.bench.case import Case, Seen, Truth
from tagmetry.lab.bench.clutter import clutter_light
from tagmetry.lab.bench.setup import Setup
from tagmetry.markers import MountedMarker
from tagmetry.markers import family as family_of
from tagmetry.twin import Optics, Scene, Shot, exposed
from tagmetry.twin.optics import Gamma, Sensor, developed
from tagmetry.twin.scenes import Still, marker_thing

SIZE_M = 0.1
_BLACK, _WHITE, _BACKGROUND = 0.12, 0.82, 0.45  # radiance, of full scale
_MOST_TILT_DEG = 35.0
_SWING_PX, _SWING_DEG = 6.0, 3.0  # of 12 images: 3 px an image, and 1.6 px off a straight path
_ROUNDING_GREY = 1 / np.sqrt(12)
_HERE = Still(RigidTransform.identity())


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
    return Case(
        setup.name,
        family,
        tuple(_photograph(setup, camera, markers, behind, rng) for markers in films),
        tuple(_truth(markers, camera) for markers in films),
        _seen(setup, camera),
        setup.is_standard,
        setup.images > 1,
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


def _photograph(
    setup: Setup,
    camera: Camera,
    markers: Sequence[MountedMarker],
    behind: FloatImage,
    rng: np.random.Generator,
) -> GreyPixels:
    """Return an image: the markers' own light, and of what is behind them what they leave free."""
    things = (marker_thing(markers, paper=_WHITE, ink=_BLACK),) if markers else ()
    shot = Shot(camera, _HERE, optics=Optics(blur_px=setup.blur_px))
    own = exposed(Scene(things, background=0.0), shot)
    free = exposed(Scene(things, background=1.0), shot) - own
    sensor = Sensor(response=Gamma(setup.exponent), noise_grey=setup.noise)
    return np.asarray(developed(own + free * behind, sensor, rng), dtype=np.uint8)


def _truth(markers: Sequence[MountedMarker], camera: Camera) -> Truth:
    if not markers:
        return Truth(np.empty(0, np.int64), np.empty((0, 4, 2)))
    return Truth(
        np.array([marker.id for marker in markers]),
        np.stack([camera.project(marker.corners_m) for marker in markers]),
        RigidTransform.concatenate([marker.T_body_marker for marker in markers]),
    )


def _seen(setup: Setup, camera: Camera) -> Seen:
    black, white = (255.0 * level ** (1 / setup.exponent) for level in (_BLACK, _WHITE))
    noise = float(np.hypot(setup.noise, _ROUNDING_GREY))
    return Seen(camera, SIZE_M, black, white, setup.blur_px, setup.exponent, noise)


def _films(
    setup: Setup, camera: Camera, family: str, rng: np.random.Generator
) -> list[list[MountedMarker]]:
    """Return the markers of every image, at their poses in the camera."""
    ids = np.arange(setup.count) % len(family_of(family))
    depth_m = SIZE_M * setup.size_px[0] / setup.side_px
    paths = [_poses(setup, camera, n, depth_m, rng) for n in range(setup.count)]
    return [
        [MountedMarker(family, int(ids[n]), SIZE_M, path[k]) for n, path in enumerate(paths)]
        for k in range(setup.images)
    ]


def _poses(
    setup: Setup, camera: Camera, n: int, depth_m: float, rng: np.random.Generator
) -> list[RigidTransform]:
    """Return T_camera_marker of a marker in every image."""
    at_px = _place_px(setup, n)
    turn_deg, tilt_deg, lean_deg = rng.uniform(-1, 1, 3) * [180, _MOST_TILT_DEG, _MOST_TILT_DEG]
    phase_rad = rng.uniform(0, 2 * np.pi)
    poses = []
    for k in range(setup.images):
        swing = _swing(setup, 2 * np.pi * k / setup.images + phase_rad)
        ray = camera.unproject(at_px + _SWING_PX * swing)
        angles = [180 + tilt_deg, lean_deg, turn_deg + _SWING_DEG * swing[0]]
        R_camera_marker = Rotation.from_euler("xyz", angles, degrees=True)
        poses.append(RigidTransform.from_components(ray / ray[2] * depth_m, R_camera_marker))
    return poses


def _swing(setup: Setup, phase_rad: float) -> Array:
    """Return where on its round a marker is; one of a single image stands still."""
    round_ = np.array([np.cos(phase_rad), np.sin(phase_rad)])
    return round_ if setup.images > 1 else np.zeros(2)


def _place_px(setup: Setup, n: int) -> Array:
    """Return the middle of the nth of as many equal fields as there are markers."""
    width_px, height_px = setup.size_px
    columns = int(np.ceil(np.sqrt(setup.count * width_px / height_px)))
    rows = -(-setup.count // columns)
    row, column = divmod(n, columns)
    return np.array([(column + 0.5) * width_px / columns, (row + 0.5) * height_px / rows]) - 0.5
