"""Sheets out of focus: each is spread by its own depth, then laid behind the nearer ones.

Light and cover of a sheet are spread alike, so that a blurred edge is half transparent, as it is
where the lens looks past it.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.optics.defocus import spread_by_depth
from tagmetry.twin.optics.spread import pixel_means
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.canvas import Canvas, Patch
from tagmetry.twin.rendering.fineness import LARGEST_DISC_PX, fine_of, gaussian_reach_px
from tagmetry.twin.rendering.grid import Grid
from tagmetry.twin.rendering.lean import moved_px
from tagmetry.twin.rendering.moments import Moment
from tagmetry.twin.rendering.paint import painted
from tagmetry.twin.rendering.seen import SeenSheet
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.scene import Scene

_NEAREST_M = 1e-6


def layered(
    light: FloatImage, tile: Box, during: Sequence[Moment], scene: Scene, shot: Shot
) -> None:
    """Fill a tile of the image's light."""
    window = light[tile.pixels]
    total = np.zeros_like(window)
    for moment in during:
        canvas = Canvas.empty(window.shape)
        for one in reversed(moment.seen):
            _lay_behind(canvas, tile, one, moment.view, scene, shot)
        total += canvas.before(scene.background)
    window[:] = total / len(during)


def _lay_behind(
    canvas: Canvas, tile: Box, one: SeenSheet, view: View, scene: Scene, shot: Shot
) -> None:
    """Lay a sheet, spread, behind what a tile shows already."""
    reach_px = gaussian_reach_px(shot.optics) + int(np.ceil(_discs_px(one, shot).max()))
    box = tile & one.box.grown(reach_px)
    window = box.inside(tile)
    if not (box and canvas.has_room(window)):
        return
    wide = box.grown(reach_px)
    grid = Grid(shot.camera, wide, fine_of(shot, moved_px([one], wide, shot.camera)))
    patch = painted(one, grid.box, grid, view, scene.light)
    discs_px = _discs_over_px(one, grid, shot)
    blur_px = shot.optics.blur_px
    radiance, share = (
        pixel_means(spread_by_depth(part, grid.fine, discs_px, blur_px), grid.fine)
        for part in (patch.radiance, patch.share)
    )
    inner = box.inside(grid.box)
    canvas.lay_behind(Patch(radiance[inner], share[inner]), window)


def _discs_px(one: SeenSheet, shot: Shot) -> Array:
    """Return the radii of the discs at a sheet's corners, those behind the camera left out."""
    return _discs_at_px(_corner_depths_m(one), shot)


def _discs_over_px(one: SeenSheet, grid: Grid, shot: Shot) -> Array:
    """Return the radius of the disc at every point of a grid; past the sheet, as at its corners."""
    x_m, y_m = (hit[:-1, :-1] for hit in grid.hits_m(grid.box, one.T_camera_sheet))
    right, up = one.T_camera_sheet.rotation.as_matrix()[2, :2]
    depth_m = one.T_camera_sheet.translation[2] + right * x_m + up * y_m
    corners_m = _corner_depths_m(one)
    depth_m = np.clip(np.nan_to_num(depth_m, nan=corners_m.max()), corners_m.min(), corners_m.max())
    return _discs_at_px(depth_m, shot)


def _corner_depths_m(one: SeenSheet) -> Array:
    depths_m = one.T_camera_sheet.apply(one.sheet.corners_m)[:, 2]
    return np.maximum(depths_m, _NEAREST_M)


def _discs_at_px(depths_m: Array, shot: Shot) -> Array:
    optics = shot.optics
    if optics.lens is None:
        return np.zeros_like(depths_m)
    return np.minimum(optics.lens.blur_radius_px(depths_m, optics.focus_m), LARGEST_DISC_PX)
