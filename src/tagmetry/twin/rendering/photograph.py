"""Pictures of scenes with exact truth.

    picture = compressed (zoomed (numbers of the sensor (light on its pixels)))

Every pixel is the exact mean of what its footprint shows. See `expose` for the light.
"""

from dataclasses import replace

import numpy as np

from tagmetry.geometry.arrays import AnyPixels
from tagmetry.twin.optics.sensor import developed, through_jpeg
from tagmetry.twin.rendering.expose import exposed
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.scenes import Scene


def photograph(scene: Scene, shot: Shot, rng: np.random.Generator) -> AnyPixels:
    """Return the picture of a scene, shape (height, width), uint8 or, above 8 bits, uint16.

    Args:
        scene: What there is to see.
        shot: Who sees it, and how. `shot.picture_camera` has the picture's intrinsics.
        rng: Where the noise comes from.
    """
    light = exposed(scene, shot) * np.float32(shot.brightness)
    raw = developed(light, replace(shot.sensor, jpeg_quality=None), rng)
    pixels = shot.zoom.pixels(raw, shot.sensor.white_grey)
    quality = shot.sensor.jpeg_quality
    return pixels if quality is None else through_jpeg(pixels, quality)
