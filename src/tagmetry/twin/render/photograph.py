"""Pictures of scenes with exact truth.

    picture = numbers of the sensor (light on its pixels)

Every pixel is the exact mean of what its footprint shows. See `expose` for the light.
"""

import numpy as np

from tagmetry.geometry.arrays import AnyPixels
from tagmetry.twin.render.expose import exposed
from tagmetry.twin.render.shot import Shot
from tagmetry.twin.scenes import Scene
from tagmetry.twin.sensor import developed


def photograph(scene: Scene, shot: Shot, rng: np.random.Generator) -> AnyPixels:
    """Return the picture of a scene, shape (height, width), uint8 or, above 8 bits, uint16.

    Args:
        scene: What there is to see.
        shot: Who sees it, and how.
        rng: Where the noise comes from.
    """
    light = exposed(scene, shot)
    return developed(light * np.float32(shot.brightness), shot.sensor, rng)
