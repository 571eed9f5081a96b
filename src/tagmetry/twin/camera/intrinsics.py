"""The exact intrinsics of a simulated camera's images at a setting.

A thin lens focused at d has its sensor at v = 1 / (1/f - 1/d), so with the share s of it that shows

    focal_px(d) = focal_px(infinity) (1 + s (v / f - 1)),  k(d) = k(infinity) + dk / d.
"""

from dataclasses import replace

import numpy as np

from tagmetry.camera import Camera, scaled, zoomed
from tagmetry.camera.brown_lens import BrownLens
from tagmetry.camera.fisheye_lens import FisheyeLens
from tagmetry.camera.lens import Lens
from tagmetry.errors import InputError
from tagmetry.twin.camera.device import Device
from tagmetry.twin.camera.setting import Setting
from tagmetry.twin.rendering import DigitalZoom, Optics, Shot, Shutter
from tagmetry.twin.scenes import Path


def image_camera(device: Device, setting: Setting) -> Camera:
    """Return the intrinsics of the images that a device gives at a setting."""
    camera = zoomed(sensor_camera(device, setting.focus), setting.zoom_percent / 100)
    return replace(scaled(camera, *device.size_px), provenance="the twin's own truth")


def sensor_camera(device: Device, focus: float) -> Camera:
    """Return the intrinsics of the whole sensor's image at a focus value."""
    focus_m = device.focus_law.distance_m(focus)
    nearer = device.lens.image_distance_m(focus_m) / device.lens.focal_m - 1
    magnified = 1 + device.breathing.focal_share * nearer
    fx, fy = device.sensor.focal_px
    return replace(
        device.sensor,
        focal_px=(fx * magnified, fy * magnified),
        lens=_bent_more(device.sensor.lens, device.breathing.distortion_m, focus_m),
        focus=focus,
        name=device.name,
    )


def sensor_shot(device: Device, setting: Setting, path: Path, time_s: float) -> Shot:
    """Return what the whole sensor sees, and what is given out of it: for the truth of an image.

    Args:
        device: The camera's hardware.
        setting: What it is set to.
        path: Where the camera is, T_world_camera.
        time_s: Middle of the exposure.
    """
    return Shot(
        sensor_camera(device, setting.focus),
        path,
        time_s,
        Optics(lens=device.lens, focus_m=device.focus_law.distance_m(setting.focus)),
        Shutter(setting.exposure_s, device.line_s),
        zoom=DigitalZoom(setting.zoom_percent / 100, *device.size_px, device.interpolation),
    )


def _bent_more(lens: Lens, distortion_m: tuple[float, ...], focus_m: float) -> Lens:
    if not distortion_m:
        return lens
    if len(distortion_m) != len(lens.coefficients):
        raise InputError(
            f"breathing needs one number for each of the lens's {len(lens.coefficients)} "
            f"distortion coefficients, got {len(distortion_m)}"
        )
    bent = np.add(lens.coefficients, np.divide(distortion_m, focus_m))
    coefficients = tuple(float(k) for k in bent)
    return BrownLens(coefficients) if lens.kind == "brown" else FisheyeLens(coefficients)
