"""What a page is told of a run that no page saw, of the states and images of a recording.

What was not recorded stays unsaid: links, batteries and reasons, and who stood under which marker.
"""

from tagmetry.arena import RobotState
from tagmetry.live.messages import LiveRobot, Picture, World
from tagmetry.live.messages.wire import format_message, packed
from tagmetry.live.show.feed import jpeg_of, small_enough
from tagmetry.live.show.told import ellipse_of
from tagmetry.record.mcap.images import parse_image
from tagmetry.record.mcap.states import parse_state

_RADIUS_M = 0.06  # of a robot's circle; a recording does not say it


def world_of_state(text: bytes) -> bytes:
    """Return a recorded state as a `World`.

    Raises:
        InputError: It is no state.
    """
    state = parse_state(text)
    robots = tuple(_robot(one) for one in sorted(state.robots, key=lambda one: one.id))
    return format_message(World(state.time_s, robots, (), False, "")).encode()


def picture_of_image(text: bytes) -> bytes:
    """Return a recorded image as a `Picture`, no larger than pages get it, without markers.

    Raises:
        InputError: It is no image.
    """
    image = parse_image(text)
    small = small_enough(image.pixels)
    height_px, width_px = small.shape[:2]
    told = packed(Picture(image.time_s, 0.0, width_px, height_px, (), jpeg_of(small)))
    return told if isinstance(told, bytes) else told.encode()


def _robot(state: RobotState) -> LiveRobot:
    return LiveRobot(
        id=state.id,
        name=state.name,
        x_m=state.x_m,
        y_m=state.y_m,
        heading_rad=state.heading_rad,
        speed_mps=state.speed_mps,
        radius_m=_RADIUS_M,
        ellipse=ellipse_of(state.covariance[:2, :2]),
        age_s=state.age_s,
        is_seen=state.seen,
        is_stopped=False,
        why="",
        task="own",
        path_m=(),
        odometry=None,
        wheels_radps=None,
        battery_v=None,
        loss=0.0,
        round_trip_s=None,
        neighbours=(),
    )
