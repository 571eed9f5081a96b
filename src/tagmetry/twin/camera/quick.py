"""Images made quickly where little is to be seen: exact around things, simple elsewhere.

What lies around the things, as far as their light reaches out of focus, is taken as ever; the rest
is an image of the background alone (`empty`). A 10 mm marker fills little of a picture.
"""

from collections.abc import Iterator
from functools import reduce
from operator import or_

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.twin.camera.development import Taking, image_pixels
from tagmetry.twin.camera.empty import empty_pixels
from tagmetry.twin.camera.intrinsics import image_camera
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.seen import covered_box
from tagmetry.twin.scenes import Sheet, Thing

_SOFTENED_PX = 8.0  # of the sensor: neighbours that share light, and interpolation
_LOOKED_AT = 3  # moments from the first row's beginning to the last row's end
_MOST = 0.5  # of the image; more is taken as a whole
_NEAREST_M = 1e-3


def quick_pixels(taking: Taking, rng: np.random.Generator) -> AnyPixels:
    """Return a grey image, shape (height, width), uint8 or, above 8 bits, uint16."""
    camera = image_camera(taking.device, taking.setting)
    windows = _windows(taking, camera)
    if sum(window.area_px for window in windows) > _MOST * camera.width_px * camera.height_px:
        return image_pixels(taking, rng)
    pixels = empty_pixels(taking.device, taking.setting, taking.scene.background, rng)
    for window in windows:
        pixels[window.pixels] = image_pixels(taking, rng, window)
    return pixels


def _windows(taking: Taking, camera: Camera) -> list[Box]:
    """Return boxes of the image, apart from each other, outside of which there is nothing."""
    image = Box(0, 0, *camera.size_px)
    windows: list[Box] = []
    for thing in taking.scene.things:
        box = reduce(or_, _reached(thing, taking, camera), Box(0, 0, 0, 0)) & image
        if box:
            windows = _joined(windows, box)
    return windows


def _joined(windows: list[Box], box: Box) -> list[Box]:
    """Return windows with one more, and those that it meets made one with it."""
    while meeting := [one for one in windows if one & box]:
        windows = [one for one in windows if not one & box]
        box = reduce(or_, meeting, box)
    return [*windows, box]


def _reached(thing: Thing, taking: Taking, camera: Camera) -> Iterator[Box]:
    """Give the pixels that a thing's sheets can reach at some moments of the exposure."""
    for T_camera_thing in _poses(thing, taking):
        for sheet in thing.sheets:
            T_camera_sheet = T_camera_thing * sheet.T_thing_sheet
            box = covered_box(
                (sheet.width_m / 2, sheet.height_m / 2), (0.0, 0.0), T_camera_sheet, camera
            )
            if box:
                yield box.grown(_reach_px(sheet, T_camera_sheet, taking, camera))


def _poses(thing: Thing, taking: Taking) -> RigidTransform:
    """Return T_camera_thing at some moments while any row takes light in."""
    rows_s = taking.device.line_s * taking.device.sensor.height_px
    half_s = (taking.setting.exposure_s + rows_s) / 2
    times_s = taking.time_s + np.linspace(-half_s, half_s, _LOOKED_AT)
    return taking.path.at(times_s).inv() * thing.path.at(times_s)


def _reach_px(sheet: Sheet, T_camera_sheet: RigidTransform, taking: Taking, camera: Camera) -> int:
    """Return how far a sheet's light is spread, pixels of the image."""
    depths_m: Array = np.maximum(T_camera_sheet.apply(sheet.corners_m)[:, 2], _NEAREST_M)
    discs_px = taking.device.lens.blur_radius_px(depths_m, taking.focus_m)
    magnified = camera.focal_px[0] / taking.device.sensor.focal_px[0]
    return int(np.ceil(magnified * (float(np.max(discs_px)) + _SOFTENED_PX)))
