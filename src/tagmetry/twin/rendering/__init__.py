"""Exact pictures of scenes, by the twin's own rays."""

from tagmetry.twin.rendering.crop import DigitalZoom
from tagmetry.twin.rendering.expose import exposed
from tagmetry.twin.rendering.photograph import photograph
from tagmetry.twin.rendering.shot import Optics, Shot, Shutter
from tagmetry.twin.rendering.simple import Look, render

__all__ = ["DigitalZoom", "Look", "Optics", "Shot", "Shutter", "exposed", "photograph", "render"]
