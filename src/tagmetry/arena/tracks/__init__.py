"""Robots followed from image to image."""

from tagmetry.arena.tracks.event import TrackEvent
from tagmetry.arena.tracks.motion import Motion
from tagmetry.arena.tracks.tracks import TrackRules, Tracks

__all__ = ["Motion", "TrackEvent", "TrackRules", "Tracks"]
