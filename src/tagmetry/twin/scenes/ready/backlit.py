"""Markers round a bright window, after the experiment with backlight of Babinec et al. (2014)."""

from dataclasses import replace

import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.twin.optics.response import Hdr
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.vignetting import Vignetting
from tagmetry.twin.recipe import Recipe
from tagmetry.twin.rendering.shot import Optics, Shot
from tagmetry.twin.scenes.furniture import box
from tagmetry.twin.scenes.light import Light
from tagmetry.twin.scenes.path import Path, Still, looking
from tagmetry.twin.scenes.ready.building import UP, concrete, facing, hung, plaster
from tagmetry.twin.scenes.ready.photographer import webcam
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import Thing, marker_thing, surface

_AWAY = (0.0, -1.0, 0.0)  # from the wall, y = 0, into the room
_EYE_M = 1.4
_WINDOW_M = (1.0, 1.2)
_AMBIENT = 0.5
_VEIL = 0.06


def backlit_window(
    glow: float = 25.0,
    hdr: bool = False,
    family: str = "4x4_50",
    size_m: float = 0.16,
    distance_m: float = 2.0,
    images: int = 1,
    seed: int = 0,
) -> Recipe:
    """Markers beside a bright window: too dark for a webcam, seen by an HDR camera.

    Args:
        glow: Radiance of the window; white paper in ambient light has 0.85.
        hdr: Whether the camera has a logarithmic sensor; else it is a webcam that adapts its
            exposure to the window.
        family: Of the four markers, ids 0 to 3.
        size_m: Side of their black squares.
        distance_m: From the wall to the camera.
        images: How many.
        seed: Of the walls and of the noise.
    """
    rng = np.random.default_rng(seed)
    aside_m = _WINDOW_M[0] / 2 + 0.2 + size_m / 2
    places = np.array([[-1, 0.22], [1, 0.22], [-1, -0.22], [1, -0.22]]) * [aside_m, 1.0]
    markers = hung(family, range(4), size_m, places, rng.uniform(-3, 3, 4))
    things = (
        plaster("wall", (6.0, 3.0), facing((0, 0, 1.5), _AWAY), rng),
        concrete("floor", (6.0, 6.0), facing((0, -3, 0), UP), rng, 0.3),
        *_window(glow),
        marker_thing(markers, Still(facing((0, 0, _EYE_M), _AWAY))),
        box("bench", (1.4, 0.35, 0.45), Still(facing((0, -0.3, 0.225), UP)), brightness=0.3),
    )
    eye = np.array([0.15 * distance_m, -distance_m, _EYE_M - 0.1])
    path = Still(looking(eye, np.array([0.0, 0.0, _EYE_M])))
    shot = _hdr_camera(path, glow) if hdr else _dazzled(path, glow)
    return Recipe(Scene(things, Light(_AMBIENT)), shot, images, seed=seed)


def _window(glow: float) -> list[Thing]:
    """Return a window of four panes in a dark frame."""
    width_m, height_m = _WINDOW_M
    panes = [
        surface("pane", 0.45 * width_m, 0.46 * height_m, _on_wall(x, z), brightness=0, glow=glow)
        for x in (-0.24 * width_m, 0.24 * width_m)
        for z in (-0.24 * height_m, 0.24 * height_m)
    ]
    return [surface("frame", width_m, height_m, _on_wall(0.0, 0.0), brightness=0.5), *panes]


def _on_wall(x_m: float, up_m: float) -> Still:
    return Still(facing((x_m, 0.0, _EYE_M + up_m), _AWAY))


def _dazzled(path: Path, glow: float) -> Shot:
    """Return a webcam whose exposure keeps most of the window below full scale."""
    shot = webcam(path, brightness=1.0 / glow)
    return replace(shot, optics=replace(shot.optics, veil=_VEIL))


def _hdr_camera(path: Path, glow: float) -> Shot:
    """Return a camera of 768x576 pixels that answers with the logarithm of bright light."""
    return Shot(
        Camera(768, 576, (620.0, 620.0), (381.9, 289.3), BrownLens((-0.15, 0.05, 0.0, 0.0))),
        path,
        optics=Optics(0.9, vignetting=Vignetting(0.7), veil=_VEIL / 3),
        sensor=Sensor(
            full_well_e=20_000, read_noise_e=12, response=Hdr(float(np.log2(2 * glow)), 0.15)
        ),
        brightness=1.6,
    )
