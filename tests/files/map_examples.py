"""A marker map, and texts that are read as one."""

import numpy as np

from tagmetry.files.maps import MapDefaults, load_map
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap

FORMATS = ["tagmetry", "wpilib", "apriltag_ros", "tagslam", "aruco"]
ONE = """tagmetry: marker map
version: 1
markers:
- {id: 3, family: tag36h11, size_m: 0.16, translation_m: [1, 2, 3], rotation_xyzw: [0, 0, 0, 1]}
"""


def a_map(count=4):
    rng = np.random.default_rng(0)
    markers = []
    for n in range(count):
        mix = rng.normal(size=(6, 6)) * 1e-3
        T = RigidTransform.from_components(rng.normal(size=3), Rotation.random(rng=rng))
        body = "crate" if n % 2 else None
        markers.append(MapMarker("tag36h11", 2 * n, 0.1 + 0.01 * n, T, mix @ mix.T, body))
    return MarkerMap(tuple(markers), "hall")


def named(map_format, folder):
    return folder / ("map.json" if map_format == "wpilib" else "map.yaml")


def read(text, folder, **defaults):
    path = folder / "map.yaml"
    path.write_text(text)
    return load_map(path, MapDefaults(**defaults))
