"""One sheet as the camera sees it: its light and its cover, exact on every point of a fine grid.

A point of the grid is the mean of what its footprint shows (`coverage`, `dots`), at the pose that
its row sees.
"""

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.canvas import Patch
from tagmetry.twin.rendering.coverage import footprint_means
from tagmetry.twin.rendering.dots import disc_shares
from tagmetry.twin.rendering.grid import Grid
from tagmetry.twin.rendering.seen import SeenSheet, covered_box
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.light import Light
from tagmetry.twin.scenes.sheet import Dot, Print, Sheet

_SOLID = np.ones((1, 1))
_ROWS_LOOKED_AT = 9


def painted(one: SeenSheet, box: Box, grid: Grid, view: View, light: Light) -> Patch:
    """Return the light and the cover of a sheet in a box of pixels of a grid.

    Args:
        one: What is seen.
        box: Where, within the grid.
        grid: The grid.
        view: Who sees it.
        light: What shines on it.
    """
    sheet = one.sheet
    Ts_camera_sheet = _poses(one, grid, view)
    x_m, y_m = grid.hits_m(box, Ts_camera_sheet)
    _, share = footprint_means(x_m / sheet.width_m + 0.5, 0.5 - y_m / sheet.height_m, _SOLID)
    ink = np.zeros_like(share)
    for printed, own in _prints_within(sheet, box, Ts_camera_sheet, grid):
        rows, columns = own.inside(box, grid.fine)
        corners = slice(rows.start, rows.stop + 1), slice(columns.start, columns.stop + 1)
        ink[rows, columns] += _ink_share(printed, x_m[corners], y_m[corners])
    reflected = sheet.paper * share + (sheet.ink - sheet.paper) * ink
    if light.lamps or light.ambient != 1.0:
        T_world_sheet = view.T_world_thing(one.thing.path) * sheet.T_thing_sheet
        reflected *= _lit(x_m, y_m, grid.fine, light, T_world_sheet)
    radiance = reflected + sheet.glow * share
    return Patch(radiance.astype(np.float32), share.astype(np.float32))


def _poses(one: SeenSheet, grid: Grid, view: View) -> RigidTransform:
    """Return T_camera_sheet, once or for each of the grid's rows."""
    if not view.rolls_over(one.thing.path):
        return one.T_camera_sheet
    return view.Ts_camera_thing(one.thing.path, grid.rows_px) * one.sheet.T_thing_sheet


def _prints_within(
    sheet: Sheet, box: Box, Ts_camera_sheet: RigidTransform, grid: Grid
) -> list[tuple[Print | Dot, Box]]:
    """Return the prints that can be seen in a box, each with its own part of it."""
    some = _some_of(Ts_camera_sheet)
    boxes = [covered_box(one.half_m, one.center_m, some, grid.camera) for one in sheet.prints]
    both = zip(sheet.prints, boxes, strict=True)
    return [(one, own & box) for one, own in both if own & box]


def _some_of(Ts_camera_sheet: RigidTransform) -> RigidTransform:
    if Ts_camera_sheet.single:
        return Ts_camera_sheet
    return Ts_camera_sheet[np.linspace(0, len(Ts_camera_sheet) - 1, _ROWS_LOOKED_AT).astype(int)]


def _ink_share(one: Print | Dot, x_m: Array, y_m: Array) -> Array:
    x_m, y_m = x_m - one.center_m[0], y_m - one.center_m[1]
    if isinstance(one, Dot):
        return disc_shares(x_m, y_m, one.radius_m)
    rows, columns = one.ink.shape
    return footprint_means(x_m / one.cell_m + columns / 2, rows / 2 - y_m / one.cell_m, one.ink)[0]


def _lit(
    x_m: Array, y_m: Array, fine: int, light: Light, T_world_sheet: RigidTransform
) -> FloatImage:
    """Return the light on every footprint: between that on the corners of its pixel."""
    x_m, y_m = x_m[::fine, ::fine], y_m[::fine, ::fine]
    p_sheet = np.nan_to_num(np.stack([x_m, y_m, np.zeros_like(x_m)], axis=-1))
    p_world = T_world_sheet.apply(p_sheet.reshape(-1, 3)).reshape(p_sheet.shape)
    corners = light.on(p_world, T_world_sheet.rotation.as_matrix()[:, 2]).astype(np.float32)
    share = ((np.arange(fine, dtype=np.float32) + 0.5) / fine)[:, None]
    rows = corners[:-1, None] * (1 - share) + corners[1:, None] * share
    rows = rows.reshape(-1, corners.shape[1])[:, :, None]
    share = share[:, 0]
    return np.asarray((rows[:, :-1] * (1 - share) + rows[:, 1:] * share).reshape(len(rows), -1))
