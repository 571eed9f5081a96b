"""The light on the scene: how bright a white sheet is at a place.

Sheets are matt (Lambertian). A sheet under the ambient light alone has irradiance 1; a lamp adds

    E = strength (n . l) / d^2,

with l the direction to the lamp, d the distance in metres and n the sheet's normal. There are no
shadows.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Lamp:
    """A small lamp.

    Attributes:
        p_world: Where it is, shape (3,).
        strength: What it adds to a sheet that faces it at 1 m; the ambient light is 1.
    """

    p_world: Array
    strength: float


@dataclass(frozen=True, eq=False)
class Light:
    """All the light there is.

    Attributes:
        ambient: Light that comes from everywhere.
        lamps: Light that comes from places.
    """

    ambient: float = 1.0
    lamps: tuple[Lamp, ...] = ()

    def on(self, p_world: Array, normal: Array) -> Array:
        """Return the irradiance at places (..., 3) of a sheet with a unit normal (3,)."""
        light = np.full(p_world.shape[:-1], self.ambient)
        for lamp in self.lamps:
            to_lamp = lamp.p_world - p_world
            distance2 = np.einsum("...i,...i->...", to_lamp, to_lamp)
            facing = np.maximum(np.einsum("...i,i->...", to_lamp, normal), 0.0)
            light += lamp.strength * facing / (distance2 * np.sqrt(distance2))
        return light
