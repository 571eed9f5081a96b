"""What is told of the robots, and of what they are among."""

from dataclasses import dataclass
from typing import Literal

Task = Literal["own", "visit", "walk", "wait"]


@dataclass(frozen=True)
class LiveRobot:
    """One robot.

    Attributes:
        id: Its own number.
        name: What people call it; any text.
        x_m: Its centre in the world.
        y_m: Its centre in the world.
        heading_rad: From the world's x, counter-clockwise.
        speed_mps: Along its forward axis.
        radius_m: Of the circle that it stays in.
        ellipse: Of its place, one standard deviation: long and short half axis, m, and the long
            one's direction, rad.
        age_s: Since the last image that showed it.
        is_seen: The newest image shows it.
        is_stopped: It has to stand still.
        why: The reasons, in words.
        task: "own" while its controller drives; else what a person asked: to visit a place, to walk
            a path, to wait.
        path_m: (x, y) of the way points that a person gave, the goal last; none otherwise.
        odometry: (x, y, heading) as its wheels say, in its own frame; None before it told.
        wheels_radps: How fast its left and its right wheel turn, by its encoders; None before.
        battery_v: As it told last; None before.
        loss: Share of its packets that did not arrive.
        round_trip_s: To the host and back; None before it was measured.
        neighbours: Ids of the robots that it senses.
    """

    id: int
    name: str
    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    radius_m: float
    ellipse: tuple[float, float, float]
    age_s: float
    is_seen: bool
    is_stopped: bool
    why: str
    task: Task
    path_m: tuple[tuple[float, float], ...]
    odometry: tuple[float, float, float] | None
    wheels_radps: tuple[float, float] | None
    battery_v: float | None
    loss: float
    round_trip_s: float | None
    neighbours: tuple[int, ...]


@dataclass(frozen=True)
class LiveMarker:
    """A marker in the camera's picture.

    Attributes:
        robot_id: Whose.
        corners_px: In the picture as it is sent, clockwise from the marker's top left.
        front_px: A point before the robot, seen from the marker's centre.
    """

    robot_id: int
    corners_px: tuple[tuple[float, float], ...]
    front_px: tuple[float, float]


@dataclass(frozen=True)
class World:
    """Where all robots are.

    Attributes:
        time_s: In the arena's clock.
        robots: By rising id; robots that were never seen are not among them.
        missing: Names of the robots that were never seen.
        is_stopped: The stop for all is pressed.
        why: Who or what pressed it.
    """

    time_s: float
    robots: tuple[LiveRobot, ...]
    missing: tuple[str, ...]
    is_stopped: bool
    why: str


@dataclass(frozen=True)
class LiveParameter:
    """A number of the controllers that can be changed.

    Attributes:
        name: With its unit.
        value: As it is set.
        least: That can be set.
        most: That can be set.
        meaning: In words.
    """

    name: str
    value: float
    least: float
    most: float
    meaning: str


@dataclass(frozen=True)
class Stage:
    """What robots are among, and what can be set; told when it changes.

    Attributes:
        scenario: What runs.
        reach_m: Of the robots' sensor for neighbours, from centre to centre.
        fence_m: (x, y) of the corners that robots stay within; none where there is no fence.
        discs: Virtual obstacles: x, y and radius, m.
        walls: Virtual obstacles: x and y of both ends, m.
        parameters: Of the controllers.
    """

    scenario: str
    reach_m: float
    fence_m: tuple[tuple[float, float], ...]
    discs: tuple[tuple[float, float, float], ...]
    walls: tuple[tuple[float, float, float, float], ...]
    parameters: tuple[LiveParameter, ...]
