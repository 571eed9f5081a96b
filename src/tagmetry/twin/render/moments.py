"""The moments of an exposure: motion blur is their mean.

Each stands in the middle of its part of the exposure, so that places are exact. From one to the
next things move by no more than the point spread smooths over (a blur of s px leaves
exp(-2 pi^2 s^2 / d^2) of steps of d px: 3e-9 for d = s), and by a quarter of a pixel without any.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.twin.render.fineness import LARGEST_DISC_PX, gaussian_reach_px
from tagmetry.twin.render.rays import Rays
from tagmetry.twin.render.seen import SeenSheet, seen_sheets
from tagmetry.twin.render.shot import Shot
from tagmetry.twin.render.view import View
from tagmetry.twin.scenes.scene import Scene

_LEAST_STEP_PX, _MOST_STEP_PX = 0.25, 1.0
_MOST = 400
_LOOKED_AT = 5


@dataclass(frozen=True, eq=False)
class Moment:
    """One moment of an exposure.

    Attributes:
        view: The camera.
        seen: The sheets that it sees, what is painted first first.
    """

    view: View
    seen: list[SeenSheet]


def moments(scene: Scene, shot: Shot) -> list[Moment]:
    """Return the moments of an exposure; one, where nothing moves in it."""
    reach_px = gaussian_reach_px(shot.optics)
    reach_px += LARGEST_DISC_PX * (shot.optics.lens is not None)
    step_px = np.clip(shot.optics.blur_px, _LEAST_STEP_PX, _MOST_STEP_PX)
    count = int(np.clip(np.ceil(_motion_px(scene, shot) / step_px), 1, _MOST))
    late_s = ((np.arange(count) + 0.5) / count - 0.5) * shot.shutter.exposure_s
    views = [shot.view(float(late)) for late in late_s]
    return [Moment(view, seen_sheets(scene, view, reach_px)) for view in views]


def _motion_px(scene: Scene, shot: Shot) -> float:
    """Return how far anything moves over the image during the exposure."""
    moving = shot.path.moves or any(thing.path.moves for thing in scene.things)
    if shot.shutter.exposure_s == 0 or not moving or not scene.things:
        return 0.0
    during_s = np.linspace(-0.5, 0.5, _LOOKED_AT) * shot.shutter.exposure_s
    places = np.stack([_corners_px(scene, shot.view(float(late))) for late in during_s])
    steps = np.linalg.norm(np.diff(places, axis=0), axis=-1)
    return float(np.nan_to_num(steps, nan=0.0, posinf=0.0).sum(axis=0).max())


def _corners_px(scene: Scene, view: View) -> Array:
    p_camera = [
        (view.T_camera_thing(thing.path) * sheet.T_thing_sheet).apply(sheet.corners_m)
        for thing in scene.things
        for sheet in thing.sheets
    ]
    return Rays(view.camera).see(np.concatenate(p_camera))
