"""Marker maps in and out: our own YAML, and the formats of others."""

from tagmetry.files.maps.load import MapFormat, load_map, save_map
from tagmetry.files.maps.places import MapDefaults

__all__ = ["MapDefaults", "MapFormat", "load_map", "save_map"]
