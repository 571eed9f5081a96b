"""Robots seen from above: where they are, what each may know, and when they have to stop."""

from tagmetry.arena.arena import Arena, ArenaStep
from tagmetry.arena.audit import AuditGrid, ErrorMap, GridPlace, audit
from tagmetry.arena.bump import BumpCheck, BumpRules, FloorCorners, check_bump, floor_corners
from tagmetry.arena.floor_layout import LaidFloor, lay_floor
from tagmetry.arena.latency import (
    Reaction,
    estimate_reaction,
    expected_heading,
    expected_light,
)
from tagmetry.arena.mounting import (
    Estimate,
    SpinCenter,
    height_at_places,
    height_by_size,
    offset_from_spin,
    turn_from_drive,
)
from tagmetry.arena.neighbour_sensor import NeighbourSensor
from tagmetry.arena.neighbours import Neighbourhood
from tagmetry.arena.obstacles import Disc, Obstacle, Wall
from tagmetry.arena.on_plane import OverheadView, point_on_plane
from tagmetry.arena.robot import Mount, Robot
from tagmetry.arena.safety import Decision, Fence, SafetyRules, StopForAll, decide
from tagmetry.arena.sighting import Roster, Sightings, sight
from tagmetry.arena.square_fit import SquareFits, fit_squares
from tagmetry.arena.told import NearObstacle, Neighbour, Told
from tagmetry.arena.tracks import Motion, TrackEvent, TrackRules, Tracks
from tagmetry.arena.view_from_floor import view_from_floor
from tagmetry.arena.wiggle import wiggle
from tagmetry.arena.world_state import STATE_NAMES, RobotState, WorldState

__all__ = [
    "STATE_NAMES",
    "Arena",
    "ArenaStep",
    "AuditGrid",
    "BumpCheck",
    "BumpRules",
    "Decision",
    "Disc",
    "ErrorMap",
    "Estimate",
    "Fence",
    "FloorCorners",
    "GridPlace",
    "LaidFloor",
    "Motion",
    "Mount",
    "NearObstacle",
    "Neighbour",
    "NeighbourSensor",
    "Neighbourhood",
    "Obstacle",
    "OverheadView",
    "Reaction",
    "Robot",
    "RobotState",
    "Roster",
    "SafetyRules",
    "Sightings",
    "SpinCenter",
    "SquareFits",
    "StopForAll",
    "Told",
    "TrackEvent",
    "TrackRules",
    "Tracks",
    "Wall",
    "WorldState",
    "audit",
    "check_bump",
    "decide",
    "estimate_reaction",
    "expected_heading",
    "expected_light",
    "fit_squares",
    "floor_corners",
    "height_at_places",
    "height_by_size",
    "lay_floor",
    "offset_from_spin",
    "point_on_plane",
    "sight",
    "turn_from_drive",
    "view_from_floor",
    "wiggle",
]
