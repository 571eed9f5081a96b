"""Where every robot of an arena is at one moment: what the arena gives to all who take from it.

Frames: `world` is z up, the floor at z = 0. A robot's heading is the angle from the world's x axis
to its own forward axis, counter-clockwise seen from above.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from tagmetry.geometry import Array

STATE_NAMES = ("x_m", "y_m", "heading_rad", "speed_mps", "turn_rate_radps")


class RobotState(NamedTuple):
    """One robot on the floor; hundreds are made of an image, hence a tuple.

    Attributes:
        id: The robot's own number in the arena; not its marker's id.
        name: What people call it.
        x_m: Its centre in the world.
        y_m: Its centre in the world.
        heading_rad: From the world's x to its forward axis, in (-pi, pi].
        speed_mps: Along its forward axis; negative backwards.
        turn_rate_radps: Counter-clockwise.
        covariance: Of `STATE_NAMES` in their order, shape (5, 5), m, rad and s.
        age_s: Time since the last image that showed it.
        seen: The image of this moment showed it; else it was carried on by its motion.
        time_s: What moment this is, in the source's clock.
    """

    id: int
    name: str
    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    turn_rate_radps: float
    covariance: Array
    age_s: float
    seen: bool
    time_s: float


@dataclass(frozen=True, eq=False)
class WorldState:
    """All robots that have a track at one moment.

    Attributes:
        time_s: The moment, in the source's clock.
        robots: By rising id, each once; a robot that was never seen is not among them.
    """

    time_s: float
    robots: tuple[RobotState, ...]

    def __iter__(self) -> Iterator[RobotState]:
        """Give the robots."""
        return iter(self.robots)

    def robot(self, robot_id: int) -> RobotState | None:
        """Return the robot of this id; None where it has no track."""
        return next((one for one in self.robots if one.id == robot_id), None)
