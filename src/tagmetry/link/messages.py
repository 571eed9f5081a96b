"""What the packets say, as values: SI units here, the wire's integers only on the wire.

Times in microseconds are those of the host's clock, `time.monotonic` of the computer that runs it.
"""

from dataclasses import dataclass, field

from tagmetry.link.layout import Kind


@dataclass(frozen=True)
class Hello:
    """A robot wants a session."""

    robot_nonce: int
    robot_us: int


@dataclass(frozen=True)
class Assign:
    """The session begins."""

    robot_nonce: int
    host_nonce: int
    robot_us: int


@dataclass(frozen=True)
class Time:
    """A robot asks for the host's time and tells how well it hears."""

    robot_us: int
    round_trip_us: int
    highest: int
    received: int
    flags: int


@dataclass(frozen=True)
class TimeReply:
    """The host's time, for the question of `robot_us`."""

    robot_us: int


@dataclass(frozen=True)
class Beat:
    """The host is alive."""


@dataclass(frozen=True)
class EmergencyStop:
    """Stop and stay stopped (`order` 1), or be released (2)."""

    edition: int
    order: int


@dataclass(frozen=True)
class Pose:
    """Where a robot is in the world; the deviations are standard deviations."""

    captured_us: int
    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float = 0.0
    turn_rate_radps: float = 0.0
    sd_position_m: float = 0.0
    sd_heading_rad: float = 0.0


@dataclass(frozen=True)
class Neighbour:
    """Another robot as seen from this one: x forward, y left, counter-clockwise."""

    id: int
    range_m: float
    bearing_rad: float
    heading_rad: float
    age_s: float = 0.0
    quality: float = 1.0


@dataclass(frozen=True)
class Neighbours:
    """The robots within reach of an emulated sensor; `omitted` more did not fit."""

    captured_us: int
    range_limit_m: float
    seen: tuple[Neighbour, ...] = ()
    omitted: int = 0


@dataclass(frozen=True)
class PackedNeighbours:
    """What `Neighbours` says, packed already, together with those of many robots."""

    body: bytes


@dataclass(frozen=True)
class Command:
    """How to move for `valid_for_ms` from the moment of sending; `lamp` from 0 to 65535.

    A lifetime of 0 holds the robot: for 250 ms it may not steer by its neighbours either.
    """

    forward_mps: float = 0.0
    left_mps: float = 0.0
    turn_radps: float = 0.0
    valid_for_ms: int = 200
    lamp: int = 0


@dataclass(frozen=True)
class Odometry:
    """What a robot's wheels say, in a frame of its own."""

    measured_us: int
    x_m: float
    y_m: float
    heading_rad: float
    forward_mps: float = 0.0
    left_mps: float = 0.0
    turn_radps: float = 0.0


@dataclass(frozen=True)
class Telemetry:
    """Numbers by name, as (name, value)."""

    measured_us: int
    readings: tuple[tuple[str, float], ...] = field(default=())


@dataclass(frozen=True)
class State:
    """Where a robot is and how sure that is; `flags` 1: the image shows it, 2: must stand still.

    The covariance is the upper triangle, row by row, of that of x, y, heading, speed, turn rate.
    """

    moment_us: int
    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    turn_rate_radps: float
    age_s: float
    flags: int
    covariance: tuple[float, ...]


@dataclass(frozen=True)
class ArenaState:
    """All of one image was told; `flags` 1: the stop for all is pressed."""

    moment_us: int
    image: int
    flags: int
    robots: int
    seen: int


Message = (
    Hello
    | Assign
    | Time
    | TimeReply
    | Beat
    | EmergencyStop
    | Pose
    | Neighbours
    | PackedNeighbours
    | Command
    | Odometry
    | Telemetry
    | State
    | ArenaState
)

KINDS: dict[type[Message], Kind] = {
    Hello: Kind.HELLO,
    Assign: Kind.ASSIGN,
    Time: Kind.TIME,
    TimeReply: Kind.TIME_REPLY,
    Beat: Kind.BEAT,
    EmergencyStop: Kind.ESTOP,
    Pose: Kind.POSE,
    PackedNeighbours: Kind.NEIGHBOURS,
    Neighbours: Kind.NEIGHBOURS,  # what is received is of the last type
    Command: Kind.COMMAND,
    Odometry: Kind.ODOMETRY,
    Telemetry: Kind.TELEMETRY,
    State: Kind.STATE,
    ArenaState: Kind.ARENA,
}
