"""Markers on a floor and a camera above them, as seed 002 has them in its simulator.

World: z up, its origin in the middle of the markers. The camera stands on the z axis, looks down,
and is turned about it (yaw). The marker itself is tilted about y (pitch) or x (roll), the camera is
not. The paper tells neither the markers' side nor the camera's focal length, nor the inclination:
200 mm, the simulator's usual 60 degrees of view, and 40 degrees are taken.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers import MountedMarker
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Still, marker_thing

LayoutName = Literal["one", "two", "four", "four inclined", "four and one perpendicular"]
LookName = Literal["simulator", "webcam"]

FAMILY = "tag36h11"
SIZE_M = 0.2
CAMERA = Camera(640, 480, (554.256, 554.256), (319.5, 239.5))
INCLINATION_DEG = 40.0

_APART_M = 0.16  # from the middle to a marker's centre, along x and y
_LOOKS = {
    "simulator": (Optics(blur_px=0.5), Sensor(noise_grey=1.0)),
    "webcam": (Optics(blur_px=1.0), Sensor(noise_grey=4.0, jpeg_quality=85)),
}
_DOWN = Rotation.from_euler("x", 180, degrees=True)
_JITTER_M, _JITTER_DEG = 0.005, 0.5


@dataclass(frozen=True)
class Stand:
    """Where camera and markers are.

    Attributes:
        layout: Which markers there are.
        distance_m: From the camera to the middle of the markers.
        yaw_deg: Of the camera about the world's z.
        pitch_deg: Of the markers about the world's y.
        roll_deg: Of the markers about the world's x.
        look: What the pictures are like.
    """

    layout: LayoutName
    distance_m: float
    yaw_deg: float = 0.0
    pitch_deg: float = 0.0
    roll_deg: float = 0.0
    look: LookName = "simulator"


def marker_map(stand: Stand) -> MarkerMap:
    """Return the markers at their places in the world."""
    R_world_plane = Rotation.from_euler("yx", [stand.pitch_deg, stand.roll_deg], degrees=True)
    if stand.layout in ("four inclined", "four and one perpendicular"):
        R_world_plane *= Rotation.from_euler("x", INCLINATION_DEG, degrees=True)
    T_world_plane = RigidTransform.from_rotation(R_world_plane)
    places = [T_world_plane * T_plane_marker for T_plane_marker in _places(stand.layout)]
    return MarkerMap(tuple(MapMarker(FAMILY, n, SIZE_M, T) for n, T in enumerate(places)))


def camera_place(stand: Stand, rng: np.random.Generator) -> RigidTransform:
    """Return T_world_camera, off by some millimetres, so that pixels fall elsewhere every time."""
    place_m = np.array([0.0, 0.0, stand.distance_m]) + rng.uniform(-_JITTER_M, _JITTER_M, 3)
    yaw = Rotation.from_euler("z", stand.yaw_deg, degrees=True)
    jitter = Rotation.from_rotvec(rng.uniform(-_JITTER_DEG, _JITTER_DEG, 3), degrees=True)
    return RigidTransform.from_components(place_m, yaw * jitter * _DOWN)


def angles_rad(T_world_camera: RigidTransform) -> Array:
    """Return yaw, pitch and roll of a camera against one that looks straight down, shape (3,)."""
    return np.asarray((T_world_camera.rotation * _DOWN.inv()).as_euler("ZYX"))


def picture(stand: Stand, T_world_camera: RigidTransform, rng: np.random.Generator) -> AnyPixels:
    """Return what the camera sees."""
    mounted = [
        MountedMarker(one.family, one.id, one.size_m, one.T_world_marker)
        for one in marker_map(stand).markers
    ]
    optics, sensor = _LOOKS[stand.look]
    shot = Shot(CAMERA, Still(T_world_camera), optics=optics, sensor=sensor)
    return photograph(Scene((marker_thing(mounted),)), shot, rng)


def _places(layout: LayoutName) -> list[RigidTransform]:
    """Return T_plane_marker of a layout's markers, upright in the plane."""
    corners_m = _APART_M * np.array([(-1, 1), (1, -1), (1, 1), (-1, -1)])
    count = {"one": 0, "two": 2}.get(layout, 4)
    if count == 0:
        return [RigidTransform.identity()]
    lying = [RigidTransform.from_translation([x, y, 0.0]) for x, y in corners_m[:count]]
    return [*lying, _standing()] if layout == "four and one perpendicular" else lying


def _standing() -> RigidTransform:
    """Return T_plane_marker of the one that stands behind the others and looks over them."""
    R_plane_marker = Rotation.from_matrix([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    return RigidTransform.from_components([0.0, -0.3, SIZE_M / 2], R_plane_marker)
