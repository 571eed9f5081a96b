"""What the server and the page say to each other: the contract, and who may say what.

Every message is a JSON object whose `type` is its class's name. `CONTRACT` declares each one's
sender and the role that it needs; the page of the protocol is written from it.
"""

from dataclasses import dataclass
from typing import Literal

from tagmetry.live.rooms.calibrate.messages import (
    CalibrationPicture,
    CalibrationState,
    EndCalibration,
    SaveCalibration,
    StartCalibration,
)
from tagmetry.live.rooms.lens.messages import LensPicture, LensTrace, StartLens, StopLens
from tagmetry.live.rooms.locate.messages import LocateTrace, StartLocate, StopLocate

Sender = Literal["server", "page"]
Role = Literal["viewer", "operator"]
Task = Literal["own", "visit", "walk", "wait"]

MOST_POINTS = 40  # of a path


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
class Welcome:
    """The first message on every connection: who you are, and what there is.

    Attributes:
        role: What this page may do.
        scenarios: That can be chosen.
        floor_m: Half the floor's extent along x and y.
        beat_s: How often a page that drives says that it is there.
    """

    role: Role
    scenarios: tuple[str, ...]
    floor_m: tuple[float, float]
    beat_s: float


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


@dataclass(frozen=True)
class Picture:
    """What the camera sees; on its way the JPEG follows the JSON in one binary message.

    Attributes:
        time_s: When it was taken, in the arena's clock.
        taken_s: The same in a clock of the server; `Seen` tells it back.
        width_px: Of the picture as it is sent.
        height_px: Of the picture as it is sent.
        markers: That were found in it.
        jpeg: The picture.
    """

    time_s: float
    taken_s: float
    width_px: int
    height_px: int
    markers: tuple[LiveMarker, ...]
    jpeg: bytes


@dataclass(frozen=True)
class StageTime:
    """How long one step of an image's way takes.

    Attributes:
        name: As people call it.
        mean_s: The mean of the last second.
    """

    name: str
    mean_s: float


@dataclass(frozen=True)
class Health:
    """How the measurement does.

    Attributes:
        scenario: What runs.
        image_rate_hz: Images measured per second of the wall's clock.
        late_s: How far the arena is behind the wall's clock.
        turn_s: Time that one image takes, the mean of the last second.
        picture_rate_hz: Pictures made per second.
        picture_age_s: Since the newest picture was taken; None before.
        viewers: Pages that are connected.
        recording: Name of the file that is being written; None while nothing is.
        notice: What went wrong last; empty while all is well.
        stages: The steps of an image's way.
        worst_loss: Share of packets that do not arrive, of the robot that loses most.
        least_battery_v: Of the robot that has least; None before one told.
        memory_bytes: That the server holds; None where the system does not say.
        disk_free_bytes: Where recordings go; None where that is not known.
        dropped_count: What the recording could not write in time.
        advice: What is wrong and what to do, a line each; none while all is well.
    """

    scenario: str
    image_rate_hz: float
    late_s: float
    turn_s: float
    picture_rate_hz: float
    picture_age_s: float | None
    viewers: int
    recording: str | None
    notice: str
    stages: tuple[StageTime, ...]
    worst_loss: float
    least_battery_v: float | None
    memory_bytes: int | None
    disk_free_bytes: int | None
    dropped_count: int
    advice: tuple[str, ...]


@dataclass(frozen=True)
class Delivery:
    """How messages reach the pages.

    Attributes:
        pages: That are connected.
        told_hz: Messages per second that pages took, all together.
        missed_hz: Messages per second that a newer one replaced before a slow page took them.
        shown_median_s: From an image until a page shows its picture, the newest 200 times, as
            pages say; None before.
        shown_p99_s: What 99 of 100 do not exceed.
    """

    pages: int
    told_hz: float
    missed_hz: float
    shown_median_s: float | None
    shown_p99_s: float | None


@dataclass(frozen=True)
class FloorErrors:
    """How far measured places are off over the floor, as `MeasureErrors` found it.

    Attributes:
        is_measuring: It is being found out; nothing is known yet.
        step_m: Between the places.
        height_m: Of the markers above the floor.
        errors: One for each place: x, y, the error along x and along y, and the stated standard
            deviation, m.
    """

    is_measuring: bool
    step_m: float
    height_m: float
    errors: tuple[tuple[float, float, float, float, float], ...]


@dataclass(frozen=True)
class Refused:
    """What the page asked for last was not done.

    Attributes:
        why: In words.
    """

    why: str


@dataclass(frozen=True)
class Beat:
    """The page that drives is open and looked at; without it for 300 ms, all robots stop."""


@dataclass(frozen=True)
class Seen:
    """The page shows a picture; it gets the next one only then, once it has said so.

    Attributes:
        taken_s: The picture's.
    """

    taken_s: float


@dataclass(frozen=True)
class Stop:
    """Stop all robots, and keep them stopped; who may look may stop.

    Attributes:
        why: Who or what asks for it.
    """

    why: str = "pressed on the page"


@dataclass(frozen=True)
class Release:
    """Let all robots move again."""


@dataclass(frozen=True)
class GoTo:
    """Send a robot to a place, where it stays until it is resumed.

    Attributes:
        robot_id: Which.
        x_m: In the world.
        y_m: In the world.
    """

    robot_id: int
    x_m: float
    y_m: float


@dataclass(frozen=True)
class FollowPath:
    """Send a robot through points; it stays at the last until it is resumed.

    Attributes:
        robot_id: Which.
        points_m: (x, y) in the world, 1 to 40 of them.
    """

    robot_id: int
    points_m: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Halt:
    """Let one robot stand still until it is resumed.

    Attributes:
        robot_id: Which.
    """

    robot_id: int


@dataclass(frozen=True)
class Resume:
    """Give a robot that was sent somewhere, or halted, back to its controller.

    Attributes:
        robot_id: Which.
    """

    robot_id: int


@dataclass(frozen=True)
class SetParameter:
    """Change a number of all controllers that have it.

    Attributes:
        name: One of those that the stage lists.
        value: Within its range.
    """

    name: str
    value: float


@dataclass(frozen=True)
class ChooseScenario:
    """Begin another scenario.

    Attributes:
        name: One of those that the welcome lists.
        robots: How many.
    """

    name: str
    robots: int


@dataclass(frozen=True)
class MeasureErrors:
    """Measure the simulated floor's error map."""


@dataclass(frozen=True)
class StartRecording:
    """Record states and pictures into a new file, which the server names."""


@dataclass(frozen=True)
class StopRecording:
    """End the recording."""


Told = (
    Welcome
    | World
    | Stage
    | Picture
    | Health
    | Delivery
    | FloorErrors
    | Refused
    | CalibrationPicture
    | CalibrationState
    | LensPicture
    | LensTrace
    | LocateTrace
)
Asked = (
    Beat
    | Seen
    | Stop
    | Release
    | GoTo
    | FollowPath
    | Halt
    | Resume
    | SetParameter
    | ChooseScenario
    | MeasureErrors
    | StartRecording
    | StopRecording
    | StartCalibration
    | EndCalibration
    | SaveCalibration
    | StartLens
    | StopLens
    | StartLocate
    | StopLocate
)

# who sends one of these drives from then on
DRIVING = (Release, GoTo, FollowPath, Resume, SetParameter, ChooseScenario)


@dataclass(frozen=True)
class Rule:
    """One line of the contract.

    Attributes:
        message: Its class.
        sender: Who sends it.
        role: What the page needs to get it, or to be heard.
    """

    message: type[Told] | type[Asked]
    sender: Sender
    role: Role

    @property
    def name(self) -> str:
        """Its `type`."""
        return self.message.__name__


CONTRACT = (
    Rule(Welcome, "server", "viewer"),
    Rule(World, "server", "viewer"),
    Rule(Stage, "server", "viewer"),
    Rule(Picture, "server", "viewer"),
    Rule(Health, "server", "viewer"),
    Rule(Delivery, "server", "viewer"),
    Rule(FloorErrors, "server", "viewer"),
    Rule(Refused, "server", "viewer"),
    Rule(CalibrationPicture, "server", "viewer"),
    Rule(CalibrationState, "server", "viewer"),
    Rule(LensPicture, "server", "viewer"),
    Rule(LensTrace, "server", "viewer"),
    Rule(LocateTrace, "server", "viewer"),
    Rule(Beat, "page", "operator"),
    Rule(Seen, "page", "viewer"),
    Rule(Stop, "page", "viewer"),  # stopping is always safe
    Rule(Release, "page", "operator"),
    Rule(GoTo, "page", "operator"),
    Rule(FollowPath, "page", "operator"),
    Rule(Halt, "page", "operator"),
    Rule(Resume, "page", "operator"),
    Rule(SetParameter, "page", "operator"),
    Rule(ChooseScenario, "page", "operator"),
    Rule(MeasureErrors, "page", "operator"),
    Rule(StartRecording, "page", "operator"),
    Rule(StopRecording, "page", "operator"),
    Rule(StartCalibration, "page", "operator"),
    Rule(EndCalibration, "page", "operator"),
    Rule(SaveCalibration, "page", "operator"),
    Rule(StartLens, "page", "operator"),
    Rule(StopLens, "page", "operator"),
    Rule(StartLocate, "page", "operator"),
    Rule(StopLocate, "page", "operator"),
)
