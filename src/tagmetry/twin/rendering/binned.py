"""The same camera with larger pixels: every two by two are read as one."""

from dataclasses import replace

from tagmetry.camera.resize import scaled
from tagmetry.twin.rendering.shot import Shot

_SIDE = 2


def binned(shot: Shot) -> Shot:
    """Return a camera of half the width and height that gathers the same light.

    A pixel holds the electrons of four, read one by one, and the blur is half as many pixels.
    """
    camera, sensor = shot.camera, shot.sensor
    full_well_e = None if sensor.full_well_e is None else _SIDE**2 * sensor.full_well_e
    return replace(
        shot,
        camera=scaled(camera, camera.width_px // _SIDE, camera.height_px // _SIDE),
        optics=replace(shot.optics, blur_px=shot.optics.blur_px / _SIDE),
        sensor=replace(sensor, full_well_e=full_well_e, read_noise_e=_SIDE * sensor.read_noise_e),
    )
