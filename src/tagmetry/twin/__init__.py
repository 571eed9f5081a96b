"""Simulated optics and images behind the same interfaces as the real ones."""

from tagmetry.twin.rendering import Look, Optics, Shot, Shutter, exposed, photograph, render
from tagmetry.twin.scenes import Scene, Thing

__all__ = [
    "Look",
    "Optics",
    "Scene",
    "Shot",
    "Shutter",
    "Thing",
    "exposed",
    "photograph",
    "render",
]
