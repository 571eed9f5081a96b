"""Marker families, boards, and bodies of several markers."""

from tagmetry.markers.board import Board
from tagmetry.markers.bodies import MarkerBody, MountedMarker, cube, marker_corners_m
from tagmetry.markers.chessboards import CharucoBoard, Chessboard
from tagmetry.markers.circles import CircleGrid
from tagmetry.markers.family import MarkerFamily
from tagmetry.markers.generate import generate_family
from tagmetry.markers.grids import AprilGrid, GridBoard
from tagmetry.markers.layout import Layout
from tagmetry.markers.predefined import family, family_names

__all__ = [
    "AprilGrid",
    "Board",
    "CharucoBoard",
    "Chessboard",
    "CircleGrid",
    "GridBoard",
    "Layout",
    "MarkerBody",
    "MarkerFamily",
    "MountedMarker",
    "cube",
    "family",
    "family_names",
    "generate_family",
    "marker_corners_m",
]
