"""Which sheets a camera sees, in the order in which they are painted."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.order import painting_order
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.sheet import Sheet, rectangle_m
from tagmetry.twin.scenes.thing import Thing

_MARGIN_PX = 2
_PER_SIDE = 8
_ROWS_LOOKED_AT = 9  # of a rolling shutter, to find what a sheet can cover


@dataclass(frozen=True, eq=False)
class SeenSheet:
    """A sheet that faces the camera.

    Attributes:
        thing: What it belongs to.
        sheet: The sheet.
        box: Pixels that it can cover.
        T_camera_sheet: Where it is for the middle row.
    """

    thing: Thing
    sheet: Sheet
    box: Box
    T_camera_sheet: RigidTransform


def seen_sheets(scene: Scene, view: View, margin_px: int) -> list[SeenSheet]:
    """Return the sheets that can be seen, what is painted first first.

    Args:
        scene: What there is.
        view: Who sees it.
        margin_px: How far around the image light still matters.
    """
    seen = [one for thing in scene.things for one in _seen_of(thing, view, margin_px)]
    if len(seen) < 2:
        return seen
    corners = np.stack([one.T_camera_sheet.apply(one.sheet.corners_m) for one in seen])
    boxes = np.array([(b.left, b.top, b.right, b.bottom) for b in (one.box for one in seen)])
    return [seen[i] for i in painting_order(corners, boxes)]


def covered_box(
    half_m: tuple[float, float],
    center_m: tuple[float, float],
    Ts_camera_sheet: RigidTransform,
    camera: Camera,
) -> Box:
    """Return the pixels that can show a rectangle on a sheet; an empty box if none do.

    Args:
        half_m: Half of its width and height.
        center_m: Its centre on the sheet.
        Ts_camera_sheet: One pose, or one for each of some rows.
        camera: Whose pixels.
    """
    p_camera = _points(_rim_m(*half_m) + np.array([*center_m, 0.0]), Ts_camera_sheet)
    if camera.lens.kind != "fisheye" and (p_camera[:, 2] <= 0).all():
        return Box(0, 0, 0, 0)
    seen = Rays(camera).see(p_camera)
    if not np.isfinite(seen).all():  # it reaches behind the camera, or past the lens's edge
        return Box(-(2**20), -(2**20), 2**20, 2**20)
    low = np.floor(np.clip(seen.min(axis=0), -(2**20), 2**20)).astype(int) - _MARGIN_PX
    high = np.ceil(np.clip(seen.max(axis=0), -(2**20), 2**20)).astype(int) + _MARGIN_PX + 1
    return Box(int(low[0]), int(low[1]), int(high[0]), int(high[1]))


def _seen_of(thing: Thing, view: View, margin_px: int) -> Iterator[SeenSheet]:
    """Give the sheets of a thing that can be seen."""
    T_camera_thing = view.T_camera_thing(thing.path)
    rows_px = np.linspace(-0.5, view.camera.height_px - 0.5, _ROWS_LOOKED_AT)
    Ts_camera_thing = view.Ts_camera_thing(thing.path, rows_px)
    image = Box(0, 0, *view.camera.size_px).grown(margin_px)
    for sheet in thing.sheets:
        T_camera_sheet = T_camera_thing * sheet.T_thing_sheet
        if T_camera_sheet.rotation.as_matrix()[:, 2] @ T_camera_sheet.translation >= 0:
            continue  # its back is turned
        half_m = (sheet.width_m / 2, sheet.height_m / 2)
        poses = Ts_camera_thing * sheet.T_thing_sheet
        if box := image & covered_box(half_m, (0, 0), poses, view.camera):
            yield SeenSheet(thing, sheet, box, T_camera_sheet)


def _rim_m(half_width_m: float, half_height_m: float) -> Array:
    """Return points along the rim of a rectangle round the origin, shape (n, 3)."""
    corners = rectangle_m(half_width_m, half_height_m)
    share = np.arange(_PER_SIDE)[:, None] / _PER_SIDE
    ends = np.roll(corners, -1, axis=0)
    return np.concatenate([a + share * (b - a) for a, b in zip(corners, ends, strict=True)])


def _points(p_sheet: Array, Ts_camera_sheet: RigidTransform) -> Array:
    """Return points of a sheet in the camera's frame, at all its poses, shape (n, 3)."""
    if Ts_camera_sheet.single:
        return np.asarray(Ts_camera_sheet.apply(p_sheet))
    return np.concatenate([pose.apply(p_sheet) for pose in Ts_camera_sheet])
