"""Where points of a thing are in a picture, also under a rolling shutter.

Row v of a rolling shutter is read at its own time t(v), so a point of a thing that moves against
the camera is seen at the (u, v) with

    (u, v) = see(T_camera_thing(t(v)) p),

found by putting v in again until it stays. A motion of s rows per row's time shrinks the error by s
each time, and nothing that is slower than the shutter fails to settle.
"""

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.path import Path

_TURNS = 100
_SETTLED_PX = 1e-11
_LOST_PX = 1e-6  # still moving: faster over the image than the shutter
_SAME_RAY = 1e-6


def places_px(p_thing: Array, thing: Path, view: View) -> Array:
    """Return the pixels at which points are seen, shape (n, 2); NaN for those that are not.

    Args:
        p_thing: Points in the thing's frame, shape (n, 3), metres.
        thing: Where the thing is.
        view: Who sees it.
    """
    rows_px = np.full(len(p_thing), (view.camera.height_px - 1) / 2)
    if view.line_s == 0 or not (view.path.moves or thing.moves):
        return _seen(_in_camera(p_thing, thing, view, rows_px), view)
    for _ in range(_TURNS):
        places = _seen(_in_camera(p_thing, thing, view, rows_px), view)
        late_px = np.nan_to_num(places[:, 1] - rows_px)
        rows_px = rows_px + late_px
        if np.abs(late_px).max(initial=0.0) < _SETTLED_PX:
            return places
    places[np.flatnonzero(np.abs(late_px) > _LOST_PX)] = np.nan
    return places


def _in_camera(p_thing: Array, thing: Path, view: View, rows_px: Array) -> Array:
    """Return points in the camera's frame, each at the time of its own row, shape (n, 3)."""
    Ts_camera_thing = view.Ts_camera_thing(thing, rows_px)
    return np.asarray(Ts_camera_thing.rotation.apply(p_thing) + Ts_camera_thing.translation)


def _seen(p_camera: Array, view: View) -> Array:
    """Return the pixels that show points, NaN for those behind the camera or past the lens."""
    rays = Rays(view.camera)
    pixels = rays.see(p_camera)
    finite = np.asarray(np.isfinite(pixels).all(axis=-1))
    looked = rays.look(*np.where(finite[:, None], pixels, view.camera.center_px).T)
    shown = np.asarray(finite & _along(looked, p_camera))
    return np.where(shown[:, None], pixels, np.nan)


def _along(rays: Array, p_camera: Array) -> BoolArray:
    """Say whether points lie on rays: past the fold of a lens, a pixel shows another point."""
    with np.errstate(invalid="ignore", divide="ignore"):
        rays = rays / np.linalg.norm(rays, axis=-1, keepdims=True)
        ways = p_camera / np.linalg.norm(p_camera, axis=-1, keepdims=True)
        return np.asarray(np.linalg.norm(rays - ways, axis=-1) < _SAME_RAY)
