"""Simulated cameras with something in front of them, by name.

Frames: the webcam's and the machine's camera are at the world's origin, looking along its z; the
overhead camera is 2.5 m over the floor, z = 0.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.twin.camera.camera import TwinCamera
from tagmetry.twin.camera.models import mono_camera, overhead_camera, webcam
from tagmetry.twin.scenes import Path, Scene, Still, Thing, looking, marker_thing

_FAMILY = "tag36h11"
_SPACING_M = 0.8


def ready_camera(name: str, *, tells_camera: bool = False) -> TwinCamera:
    """Return a simulated camera by its name.

    Args:
        name: `webcam`: a 10 mm marker, 0.15 m away; `overhead`: twelve 0.1 m markers on a floor;
            `mono`: a 30 mm marker, 0.6 m away. All are tag36h11.
        tells_camera: Give every image its exact intrinsics.
    """
    if name not in READY_CAMERAS:
        raise InputError(f"expected twin:{', twin:'.join(READY_CAMERAS)}, got twin:{name[:40]}")
    return READY_CAMERAS[name](tells_camera)


@dataclass(frozen=True, eq=False)
class BeforeCamera:
    """One marker before a camera at the world's origin.

    Attributes:
        path: Where it is, T_camera_marker; also `Along` a function of time.
        id: Of its family.
        size_m: Side of its black square.
        family: Its family.
    """

    path: Path
    id: int = 7
    size_m: float = 0.01
    family: str = _FAMILY


def facing_camera(
    depth_m: float, turn_deg: float = 0.0, x_m: float = 0.0, y_m: float = 0.0
) -> RigidTransform:
    """Return T_camera_marker of a marker that faces the camera, turned about its upright axis.

    Args:
        depth_m: Along the camera's axis.
        turn_deg: The angle phi of the experiments with a 10 mm marker; 0 faces the camera.
        x_m: To the right.
        y_m: Down.
    """
    facing = Rotation.from_euler("yx", [turn_deg, 180], degrees=True)
    return RigidTransform.from_components([x_m, y_m, depth_m], facing)


def markers_before_camera(*markers: BeforeCamera) -> Scene:
    """Return a scene of markers, each moving by itself, before a camera at the world's origin."""
    return Scene(tuple(_alone(one) for one in markers))


def marker_before_camera(
    size_m: float, depth_m: float, turn_deg: float = 0.0, marker_id: int = 7
) -> Scene:
    """Return a scene of one marker on the axis of a camera at the world's origin.

    Args:
        size_m: Side of its black square.
        depth_m: Where its centre is.
        turn_deg: How far it is turned about its upright axis; 0 faces the camera.
        marker_id: Of the family tag36h11.
    """
    at = Still(facing_camera(depth_m, turn_deg))
    return markers_before_camera(BeforeCamera(at, marker_id, size_m))


def _alone(one: BeforeCamera) -> Thing:
    marker = MountedMarker(one.family, one.id, one.size_m, RigidTransform.identity())
    return marker_thing([marker], one.path, name=f"marker {one.id}")


def _webcam(tells_camera: bool) -> TwinCamera:
    return TwinCamera(marker_before_camera(0.01, 0.15, 30.0), webcam(), tells_camera=tells_camera)


def _mono(tells_camera: bool) -> TwinCamera:
    return TwinCamera(
        marker_before_camera(0.03, 0.6, 30.0), mono_camera(), tells_camera=tells_camera
    )


def _overhead(tells_camera: bool) -> TwinCamera:
    at = looking(np.array([0.0, 0.0, 2.5]), np.zeros(3))
    return TwinCamera(
        Scene((_floor_markers(),)), overhead_camera(), Still(at), tells_camera=tells_camera
    )


def _floor_markers() -> Thing:
    """Return four columns and three rows of markers around the origin, all turned differently."""
    places = [(column, row) for row in (-1.0, 0.0, 1.0) for column in (-1.5, -0.5, 0.5, 1.5)]
    return marker_thing(
        [
            MountedMarker(
                _FAMILY,
                number,
                0.1,
                RigidTransform.from_components(
                    [_SPACING_M * column, _SPACING_M * row, 0.0],
                    Rotation.from_euler("z", 30 * number, degrees=True),
                ),
            )
            for number, (column, row) in enumerate(places)
        ]
    )


READY_CAMERAS: Mapping[str, Callable[[bool], TwinCamera]] = {
    "webcam": _webcam,
    "overhead": _overhead,
    "mono": _mono,
}
