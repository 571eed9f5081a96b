"""Commands as methods: each sends one message, and returns before it is done."""

from abc import ABC, abstractmethod
from collections.abc import Sequence

from tagmetry.live.messages import (
    Asked,
    ChooseScenario,
    FollowPath,
    GoTo,
    Halt,
    Release,
    Resume,
    SetParameter,
    Stop,
)


class Asking(ABC):
    """Something that sends what it is asked for."""

    @abstractmethod
    def send(self, asked: Asked) -> None:
        """Send a message."""

    def stop(self, why: str = "a program asked for it") -> None:
        """Stop all robots, and keep them stopped."""
        self.send(Stop(why))

    def release(self) -> None:
        """Let all robots move again."""
        self.send(Release())

    def go_to(self, robot_id: int, x_m: float, y_m: float) -> None:
        """Send a robot to a place, where it stays until it is resumed."""
        self.send(GoTo(robot_id, float(x_m), float(y_m)))

    def follow_path(self, robot_id: int, points_m: Sequence[Sequence[float]]) -> None:
        """Send a robot through points (x, y); it stays at the last until it is resumed."""
        self.send(FollowPath(robot_id, tuple((float(x_m), float(y_m)) for x_m, y_m in points_m)))

    def halt(self, robot_id: int) -> None:
        """Let one robot stand still until it is resumed."""
        self.send(Halt(robot_id))

    def resume(self, robot_id: int) -> None:
        """Give a robot back to its controller."""
        self.send(Resume(robot_id))

    def set_parameter(self, name: str, value: float) -> None:
        """Change a number of all controllers that have it; `stage` lists them."""
        self.send(SetParameter(name, float(value)))

    def choose_scenario(self, name: str, robots: int) -> None:
        """Begin another scenario; `welcome` lists them."""
        self.send(ChooseScenario(name, robots))
