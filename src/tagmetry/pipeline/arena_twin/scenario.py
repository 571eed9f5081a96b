"""What a simulated arena consists of: robots, their controllers, a camera above, and a radio."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tagmetry.arena import NeighbourSensor, Obstacle, OverheadView, Robot, SafetyRules
from tagmetry.arena.controllers import Controller
from tagmetry.arena.place import Place
from tagmetry.errors import InputError
from tagmetry.twin.robots import Block, RobotDesign, SlipperyPatch


@dataclass(frozen=True, eq=False)
class TwinRobot:
    """A simulated robot.

    Attributes:
        robot: What the arena knows of it.
        start: Where it stands at first.
        controller: Makes what drives it, anew for every run; None leaves it standing.
        design: What it is made of.
        on_board: Its controller runs on the robot and knows what its packets say; else it runs on
            the host, which sends commands.
        controller_file: Where a robot that is a process of its own finds its controller on board.
        program: What runs as that process: a program that speaks the link and the motor bus, and
            its first words; this package's own where empty.
    """

    robot: Robot
    start: Place
    controller: Callable[[], Controller] | None = None
    design: RobotDesign = field(default_factory=RobotDesign)
    on_board: bool = False
    controller_file: Path | None = None
    program: tuple[str, ...] = ()


@dataclass(frozen=True)
class Radio:
    """The way of packets, both ways.

    Attributes:
        delay_s: From sending to arrival.
        jitter_s: Up to so much more, evenly.
        loss: Share of packets that never arrive.
    """

    delay_s: float = 0.005
    jitter_s: float = 0.002
    loss: float = 0.0

    def __post_init__(self) -> None:
        if not (0 <= self.delay_s < 10 and 0 <= self.jitter_s < 10 and 0 <= self.loss <= 1):
            raise InputError(
                "a radio's delays are 0 to 10 s and its loss 0 to 1, got "
                f"{self.delay_s} s, {self.jitter_s} s and {self.loss}"
            )


@dataclass(frozen=True, eq=False)
class Scenario:
    """A simulated arena before anything moves.

    Attributes:
        robots: At least one.
        view: The camera over the floor, as the arena believes it.
        image_rate_hz: Images per second.
        camera_delay_s: From the middle of an exposure until its markers are measured.
        radio: The way of packets.
        sensor: What robots sense of each other.
        obstacles: Virtual ones, that robots are only told of.
        blocks: Solid ones, that nothing tells of.
        patches: Slippery places of the floor.
        rules: What robots are stopped for.
        seed: Of all random numbers.
    """

    robots: tuple[TwinRobot, ...]
    view: OverheadView
    image_rate_hz: float = 30.0
    camera_delay_s: float = 0.03
    radio: Radio = field(default_factory=Radio)
    sensor: NeighbourSensor = field(default_factory=lambda: NeighbourSensor(range_m=1.0))
    obstacles: tuple[Obstacle, ...] = ()
    blocks: tuple[Block, ...] = ()
    patches: tuple[SlipperyPatch, ...] = ()
    rules: SafetyRules = field(default_factory=SafetyRules)
    seed: int = 0

    def __post_init__(self) -> None:
        if not self.robots:
            raise InputError("a simulated arena needs at least one robot, got none")
        if not 1 <= self.image_rate_hz <= 250:
            raise InputError(f"expected 1 to 250 images per second, got {self.image_rate_hz}")
        if not 0 <= self.camera_delay_s < 10:
            raise InputError(f"the camera's delay is 0 to 10 s, got {self.camera_delay_s}")

    @property
    def by_id(self) -> Mapping[int, TwinRobot]:
        """The robots by their ids."""
        return {one.robot.id: one for one in self.robots}

    @property
    def delay_s(self) -> float:
        """From what happens to what a robot does about it, as the host can know it."""
        return self.camera_delay_s + self.radio.delay_s + self.radio.jitter_s / 2
