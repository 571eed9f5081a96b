"""What a page asks for."""

from dataclasses import dataclass

MOST_POINTS = 40  # of a path


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
