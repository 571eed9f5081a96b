"""A camera 1.2 m above a table, and the file of its arena: two markers on the floor, one robot."""

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation

CAMERA = Camera(640, 400, (500.0, 500.0), (318.0, 203.0))
T_CAMERA_WORLD = RigidTransform.from_components(
    [0, 0, 1.2], Rotation.from_euler("x", 180, degrees=True)
)
TABLE = """
tagmetry: arena
version: 1
name: table
camera: ceiling.yaml
marker_size_m: 0.08
diameter_m: 0.16
floor: {size_m: 0.1, toward: 101, markers: [{id: 100}, {id: 101}]}
robots:
  - {id: 1, name: ada, marker: {id: 1, height_m: 0.1}}
"""
SENSOR = "sensor: {range_m: 0.6}\n"
