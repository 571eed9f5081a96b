"""What the camera makes of a case's markers: light, motion, noise.

The markers' own light and what they leave free of the background are rendered apart, so that the
background is made once for many images.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import FloatImage, GreyPixels
from tagmetry.lab.bench.case import Seen
from tagmetry.lab.bench.setup import SIZE_M, Setup
from tagmetry.markers import MountedMarker
from tagmetry.twin import Optics, Scene, Shot, Shutter, exposed
from tagmetry.twin.optics import Gamma, Sensor, developed
from tagmetry.twin.scenes import Path, Steady, Still, marker_thing

_READ_NOISE_E = 3.0
_ROUNDING_GREY = 1 / np.sqrt(12)
_HERE = Still(RigidTransform.identity())


@dataclass(frozen=True, eq=False)
class Stage:
    """What all images of a case have in common.

    Attributes:
        setup: What to render.
        camera: Intrinsics.
        behind: Light behind the markers.
        motion_px: How far the markers move while the shutter is open, right and down.
    """

    setup: Setup
    camera: Camera
    behind: FloatImage
    motion_px: tuple[float, float]


def drawn_motion_px(setup: Setup, rng: np.random.Generator) -> tuple[float, float]:
    """Return how far the markers move in the image, right and down, in any direction."""
    if setup.motion_px == 0:
        return 0.0, 0.0
    angle_rad = rng.uniform(0, 2 * np.pi)
    return float(setup.motion_px * np.cos(angle_rad)), float(setup.motion_px * np.sin(angle_rad))


def photographed(
    stage: Stage, markers: Sequence[MountedMarker], rng: np.random.Generator
) -> GreyPixels:
    """Return an image: the markers' own light, and of what is behind them what they leave free."""
    setup = stage.setup
    black, white = setup.levels
    path = _path(setup, stage.motion_px)
    things = (marker_thing(markers, path, paper=white, ink=black),) if markers else ()
    shutter = Shutter(1.0 if path.moves else 0.0)
    shot = Shot(stage.camera, _HERE, optics=Optics(blur_px=setup.blur_px), shutter=shutter)
    own = exposed(Scene(things, background=0.0), shot)
    free = exposed(Scene(things, background=1.0), shot) - own
    return np.asarray(developed(own + free * stage.behind, _sensor(setup), rng), dtype=np.uint8)


def _path(setup: Setup, motion_px: tuple[float, float]) -> Path:
    """Return how the markers move in an exposure of one second."""
    if motion_px == (0.0, 0.0):
        return _HERE
    pixel_m = SIZE_M / setup.side_px  # at the markers' depth
    velocity_m_s = pixel_m * np.array([*motion_px, 0.0])
    return Steady(RigidTransform.identity(), velocity_m_s, np.zeros(3))


def _sensor(setup: Setup) -> Sensor:
    response = Gamma(setup.exponent)
    if setup.white_electrons is None:
        return Sensor(response=response, noise_grey=setup.noise)
    full_well_e = setup.white_electrons / setup.levels[1]
    return Sensor(
        full_well_e=full_well_e,
        read_noise_e=_READ_NOISE_E,
        response=response,
        noise_grey=setup.noise,
    )


def seen_on(stage: Stage) -> Seen:
    """Return how the markers are seen."""
    setup = stage.setup
    black, white = setup.levels_grey
    grey_per_electron = white / setup.white_electrons if setup.white_electrons else 0.0
    parts = (setup.noise, _ROUNDING_GREY, _READ_NOISE_E * grey_per_electron)
    return Seen(
        stage.camera,
        SIZE_M,
        black,
        white,
        setup.blur_px,
        setup.exponent,
        float(np.linalg.norm(parts)),
        stage.motion_px,
        grey_per_electron,
    )
