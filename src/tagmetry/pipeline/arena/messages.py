"""What robots are told, as the link's messages."""

from collections.abc import Sequence

from tagmetry.arena import RobotState, Told
from tagmetry.arena.drive import Twist
from tagmetry.link import Command, Pose
from tagmetry.link.messages import PackedNeighbours
from tagmetry.link.neighbour_table import pack_neighbour_table

_COMMAND_MS = 200


def command_message(twist: Twist) -> Command:
    """Return how to move, for the next 200 ms."""
    return Command(twist.speed_mps, 0.0, twist.turn_rate_radps, _COMMAND_MS)


def pose_message(state: RobotState, time_s: float) -> Pose:
    """Return where a robot is, at a moment of the link's clock."""
    sd_x_m, sd_y_m, sd_heading_rad = (
        state.covariance[[0, 1, 2], [0, 1, 2]].clip(0.0) ** 0.5
    ).tolist()
    return Pose(
        microseconds(time_s),
        state.x_m,
        state.y_m,
        state.heading_rad,
        state.speed_mps,
        state.turn_rate_radps,
        max(sd_x_m, sd_y_m),
        sd_heading_rad,
    )


def neighbours_messages(
    told: Sequence[Told], ranges_m: Sequence[float], time_s: float
) -> list[PackedNeighbours]:
    """Return whom robots sense within their sensors' ranges, at a moment of the link's clock."""
    return pack_neighbour_table(microseconds(time_s), ranges_m, [one.sensed for one in told])


def microseconds(time_s: float) -> int:
    """Return a time as the link counts it."""
    return round(1e6 * time_s)
