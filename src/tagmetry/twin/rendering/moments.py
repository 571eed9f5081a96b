"""The moments of an exposure: motion blur is their mean.

Each stands in the middle of its part of the exposure, so that places are exact. From one to the
next things move by no more than the point spread smooths over (a blur of s px leaves
exp(-2 pi^2 s^2 / d^2) of steps of d px: 3e-9 for d = s), and by a quarter of a pixel without any.
Of a blur that is still to come it is twice as much: steps of 2 s leave 0.007 of the ripple, and
the pixel's own area averages most of that.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.fineness import LARGEST_DISC_PX, gaussian_reach_px
from tagmetry.twin.rendering.hits import hits_m
from tagmetry.twin.rendering.seen import SeenSheet, seen_sheets
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.scene import Scene

_LEAST_STEP_PX, _MOST_STEP_PX = 0.25, 1.0
_LATER = 2.0  # steps by the deviation of a blur that is still to come
_MOST = 400
_LOOKED_AT = 5
_PER_SIDE = 4


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
    middle = Moment(shot.view(), seen_sheets(scene, shot.view(), reach_px))
    step_px = np.clip(shot.optics.blur_px, _LEAST_STEP_PX, _MOST_STEP_PX)
    step_px = max(float(step_px), _LATER * shot.optics.later_px)
    count = int(np.clip(np.ceil(_motion_px(middle, shot) / step_px), 1, _MOST))
    if count == 1:
        return [middle]
    late_s = ((np.arange(count) + 0.5) / count - 0.5) * shot.shutter.exposure_s
    views = [shot.view(float(late)) for late in late_s]
    return [Moment(view, seen_sheets(scene, view, reach_px)) for view in views]


def _motion_px(middle: Moment, shot: Shot) -> float:
    """Return how far anything in the image moves over it during the exposure."""
    if shot.shutter.exposure_s == 0:
        return 0.0
    moving = [one for one in middle.seen if shot.path.moves or one.thing.path.moves]
    return max((_sheet_motion_px(one, shot) for one in moving), default=0.0)


def _sheet_motion_px(one: SeenSheet, shot: Shot) -> float:
    """Return how far the places of a sheet that are seen in the middle of the exposure move."""
    p_thing = one.sheet.T_thing_sheet.apply(_seen_places(one, shot))
    during_s = np.linspace(-0.5, 0.5, _LOOKED_AT) * shot.shutter.exposure_s
    views = [shot.view(float(late)) for late in during_s]
    places = [view.T_camera_thing(one.thing.path).apply(p_thing) for view in views]
    seen = np.stack([Rays(shot.camera).see(place) for place in places])
    steps = np.linalg.norm(np.diff(seen, axis=0), axis=-1)
    return float(np.nan_to_num(steps, nan=0.0, posinf=0.0).sum(axis=0).max())


def _seen_places(one: SeenSheet, shot: Shot) -> Array:
    """Return places on a sheet that a few pixels of the image look at, shape (n, 3)."""
    box = one.box & Box(0, 0, *shot.camera.size_px)
    u, v = np.linspace(box.left, box.right, _PER_SIDE), np.linspace(box.top, box.bottom, _PER_SIDE)
    hits = hits_m(Rays(shot.camera).look(*np.meshgrid(u, v)), one.T_camera_sheet)
    half_m = np.array([one.sheet.width_m, one.sheet.height_m]) / 2
    places = np.clip(np.nan_to_num(np.stack(hits, axis=-1)), -half_m, half_m).reshape(-1, 2)
    return np.column_stack([places, np.zeros(len(places))])
