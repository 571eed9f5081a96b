"""The light on the sensor: what the pixels of a picture take in.

    light = mean over the exposure of (the farther sheets behind the nearer ones, spread)

The image is made tile by tile, so that a large picture needs little memory and an empty one no
time. Without a lens that defocuses, all sheets are laid over each other on the fine grid and spread
together, which is exact; with one, each is spread by its own depth first (`layered`).
"""

from collections.abc import Sequence
from functools import reduce
from operator import or_

import numpy as np

from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.optics.spread import Spread
from tagmetry.twin.optics.spread_pixels import spread_pixels
from tagmetry.twin.optics.vignetting import vignetted
from tagmetry.twin.rendering.box import Box, tiles
from tagmetry.twin.rendering.canvas import Canvas
from tagmetry.twin.rendering.fineness import fine_of, gaussian_reach_px
from tagmetry.twin.rendering.grid import Grid
from tagmetry.twin.rendering.layered import layered
from tagmetry.twin.rendering.lean import moved_px
from tagmetry.twin.rendering.moments import Moment, moments
from tagmetry.twin.rendering.paint import painted
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.scenes.scene import Scene

_TILE_PX = 256
_LOOKED_AT = 3  # moments of an exposure, to find how steeply sheets are seen


def exposed(scene: Scene, shot: Shot) -> FloatImage:
    """Return the light on the sensor's pixels, shape (height, width); radiance of the scene.

    Args:
        scene: What there is to see.
        shot: Who sees it.
    """
    tile_light = _together if shot.optics.lens is None else layered
    during = moments(scene, shot)
    light = np.full(shot.camera.size_px[::-1], scene.background, np.float32)
    for tile in tiles(*shot.camera.size_px, _TILE_PX):
        tile_light(light, tile, during, scene, shot)
    return _through_the_lens(light, shot)


def _together(
    light: FloatImage, tile: Box, during: Sequence[Moment], scene: Scene, shot: Shot
) -> None:
    """Fill a tile: all sheets over each other, spread together."""
    reach_px = gaussian_reach_px(shot.optics)
    seen = [one for moment in during for one in moment.seen if one.box & tile.grown(reach_px)]
    if not seen or not (region := tile & reduce(or_, (s.box for s in seen)).grown(reach_px)):
        return
    wide = region.grown(reach_px)
    some = [one for moment in during[:: len(during) // _LOOKED_AT + 1] for one in moment.seen]
    grid = Grid(shot.camera, wide, fine_of(shot, moved_px(some, wide, shot.camera)))
    total = np.zeros(grid.shape, np.float32)
    for moment in during:
        total += _sheets_on(grid, moment, scene)
    total /= np.float32(len(during))
    done = spread_pixels(total, grid.fine, Spread(shot.optics.blur_px))
    light[region.pixels] = done[region.inside(grid.box)]


def _sheets_on(grid: Grid, moment: Moment, scene: Scene) -> FloatImage:
    """Return the light of the sheets on a grid, at a moment."""
    canvas = Canvas.empty(grid.shape)
    for one in reversed(moment.seen):
        box = one.box & grid.box
        window = box.inside(grid.box, grid.fine)
        if box and canvas.has_room(window):
            canvas.lay_behind(painted(one, box, grid, moment.view, scene.light), window)
    return canvas.before(scene.background)


def _through_the_lens(light: FloatImage, shot: Shot) -> FloatImage:
    """Darken the corners, and scatter some of the light over the whole image."""
    light = vignetted(light, shot.camera, shot.optics.vignetting)
    veil = np.float32(shot.optics.veil)
    return light if veil == 0 else light * (1 - veil) + veil * light.mean()
