"""Exact pictures of scenes, by the twin's own rays."""

from tagmetry.twin.render.crop import DigitalZoom
from tagmetry.twin.render.expose import exposed
from tagmetry.twin.render.photograph import photograph
from tagmetry.twin.render.shot import Optics, Shot, Shutter
from tagmetry.twin.render.simple import Look, render

__all__ = ["DigitalZoom", "Look", "Optics", "Shot", "Shutter", "exposed", "photograph", "render"]
