"""Simulated optics and images behind the same interfaces as the real ones."""

from tagmetry.twin.render import Look, render

__all__ = ["Look", "render"]
