"""The short way to a picture of markers."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.markers import MountedMarker
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.rendering.photograph import photograph
from tagmetry.twin.rendering.shot import Optics, Shot
from tagmetry.twin.scenes import Scene, Still, marker_thing

_FULL_SCALE = 255.0


@dataclass(frozen=True)
class Look:
    """How a simple picture of markers looks.

    Attributes:
        black: Grey value of ink, 0 to 255.
        white: Grey value of paper.
        background: Grey value behind the markers.
        blur_px: Standard deviation of a Gaussian point spread, besides the pixel's own area.
        noise: Standard deviation of the noise, grey values.
        quiet_cells: Width of the white zone around a marker.
    """

    black: float = 30.0
    white: float = 210.0
    background: float = 120.0
    blur_px: float = 0.6
    noise: float = 1.0
    quiet_cells: float = 1.0


def render(
    markers: Sequence[MountedMarker],
    T_camera_body: RigidTransform,
    camera: Camera,
    rng: np.random.Generator,
    look: Look | None = None,
) -> AnyPixels:
    """Return a grey picture of markers on a body, shape (height, width), uint8.

    Args:
        markers: Markers at their places on the body.
        T_camera_body: Where the body is.
        camera: Intrinsics of the picture.
        rng: Where the noise comes from.
        look: Colours, blur and noise.
    """
    look = look or Look()
    seen = marker_thing(
        markers,
        Still(T_camera_body),
        quiet_cells=look.quiet_cells,
        paper=look.white / _FULL_SCALE,
        ink=look.black / _FULL_SCALE,
    )
    scene = Scene((seen,), background=look.background / _FULL_SCALE)
    shot = Shot(
        camera,
        Still(RigidTransform.identity()),
        optics=Optics(blur_px=look.blur_px),
        sensor=Sensor(noise_grey=look.noise),
    )
    return photograph(scene, shot, rng)
