"""Where cameras and robots are in a world of markers whose places are known."""

from tagmetry.localize.average import MeanOfMarkers, WeightedByDistance
from tagmetry.localize.fused import FusedByCovariance
from tagmetry.localize.joint import JointCorners
from tagmetry.localize.knowledge import Gravity, Height, Knowledge, PlanarRobot
from tagmetry.localize.localizer import METHODS, Localizer, MethodName
from tagmetry.localize.marker_map import MapMarker, MarkerMap
from tagmetry.localize.method import Method
from tagmetry.localize.planar import PlanarPose, camera_on_floor, robot_on_floor
from tagmetry.localize.result import CameraHypothesis, CameraPose, Rejection
from tagmetry.localize.seen import SeenMarker
from tagmetry.localize.single import SingleMarker

__all__ = [
    "METHODS",
    "CameraHypothesis",
    "CameraPose",
    "FusedByCovariance",
    "Gravity",
    "Height",
    "JointCorners",
    "Knowledge",
    "Localizer",
    "MapMarker",
    "MarkerMap",
    "MeanOfMarkers",
    "Method",
    "MethodName",
    "PlanarPose",
    "PlanarRobot",
    "Rejection",
    "SeenMarker",
    "SingleMarker",
    "WeightedByDistance",
    "camera_on_floor",
    "robot_on_floor",
]
