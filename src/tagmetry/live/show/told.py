"""What the page is told of one moment of the arena."""

from collections.abc import Mapping, Sequence

import numpy as np

from tagmetry.arena import Robot, RobotState, Roster
from tagmetry.arena.drive import Drive, Twist
from tagmetry.detect import Detection
from tagmetry.geometry import Array
from tagmetry.link import Odometry
from tagmetry.live.messages import LiveMarker, LiveRobot, World
from tagmetry.live.show.errands import Errand
from tagmetry.live.show.steered import Steered
from tagmetry.markers.bodies import MarkerKey
from tagmetry.pipeline.arena_twin import Moment, Scenario, TwinRobot

_POINTER_M = 0.12  # of the line that shows a heading in the picture


def told_world(
    moment: Moment, scenario: Scenario, steered: Mapping[int, Steered], why: str | None
) -> World:
    """Return where all robots are.

    Args:
        moment: The newest.
        scenario: What runs.
        steered: Every robot's controller, by id.
        why: Why the stop for all is pressed; None while it is not.
    """
    robots = tuple(
        _robot(state, moment, scenario.by_id[state.id], steered[state.id].errand)
        for state in moment.turn.step.world
    )
    seen = {one.id for one in robots}
    missing = tuple(one.robot.name for one in scenario.robots if one.robot.id not in seen)
    return World(moment.time_s, robots, missing, why is not None, why or "")


def ellipse_of(covariance: Array) -> tuple[float, float, float]:
    """Return the half axes (long, short) and the long one's direction, m and rad.

    Args:
        covariance: Of (x, y), shape (2, 2), m^2.
    """
    if not np.isfinite(covariance).all():
        return float("nan"), float("nan"), 0.0
    variances, axes = np.linalg.eigh(covariance)
    short_m, long_m = np.sqrt(np.maximum(variances, 0.0)).tolist()
    return long_m, short_m, float(np.arctan2(axes[1, 1], axes[0, 1]))


def told_markers(
    detections: Sequence[Detection], roster: Roster, scale: float
) -> tuple[LiveMarker, ...]:
    """Return the robots' markers in a picture that is sent smaller by a scale."""
    rows = roster.row_by_marker
    known = [(one, rows.get(MarkerKey(one.family, one.id))) for one in detections]
    return tuple(
        _marker(scale * (one.corners_px + 0.5) - 0.5, roster.robots[row])
        for one, row in known
        if row is not None
    )


def _marker(corners_px: Array, robot: Robot) -> LiveMarker:
    """Return a marker with the robot's front, by the middles of the marker's sides."""
    top_left, top_right, bottom_right, bottom_left = corners_px
    per_m = 1 / (2 * robot.marker_size_m)
    right = (top_right + bottom_right - top_left - bottom_left) * per_m
    up = (top_left + top_right - bottom_left - bottom_right) * per_m
    ahead = np.cos(robot.mount.turn_rad) * up + np.sin(robot.mount.turn_rad) * right
    x_px, y_px = (corners_px.mean(axis=0) + _POINTER_M * ahead).tolist()
    corners = tuple((x, y) for x, y in corners_px.tolist())
    return LiveMarker(robot.id, corners, (x_px, y_px))


def _robot(state: RobotState, moment: Moment, twin: TwinRobot, errand: Errand | None) -> LiveRobot:
    decision = next(one for one in moment.turn.decisions if one.robot_id == state.id)
    link = next(one for one in moment.links if one.robot_id == state.id)
    told = next((one for one in moment.turn.told if one.robot_id == state.id), None)
    return LiveRobot(
        state.id,
        state.name,
        state.x_m,
        state.y_m,
        state.heading_rad,
        state.speed_mps,
        twin.robot.radius_m,
        ellipse_of(state.covariance[:2, :2]),
        state.age_s,
        state.seen,
        decision.must_stop,
        decision.told,
        "own" if errand is None else errand.task,
        () if errand is None else errand.path_m,
        *_by_wheels(moment.odometry.get(state.id), twin.design.drive),
        moment.readings.get(state.id, {}).get("battery_v"),
        max(link.loss_from_robot, link.loss_to_robot),
        link.round_trip_s,
        tuple(one.id for one in told.neighbours) if told is not None else (),
    )


def _by_wheels(
    said: Odometry | None, drive: Drive
) -> tuple[tuple[float, float, float] | None, tuple[float, float] | None]:
    """Return where the wheels say that a robot is, and how fast they turn."""
    if said is None:
        return None, None
    twist = Twist(said.forward_mps, said.turn_radps)
    return (said.x_m, said.y_m, said.heading_rad), drive.wheel_speeds_radps(twist)
