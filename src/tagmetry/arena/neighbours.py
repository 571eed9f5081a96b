"""What each robot may know: its neighbours and the obstacles near it, in its own frame.

A robot's frame has x forward and y to its left; a bearing is counter-clockwise from its front, and
a relative heading is the neighbour's heading minus its own. Every robot has a sensor and random
numbers of its own, so that what one is told does not depend on who else there is.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from tagmetry.arena.neighbour_sensor import NeighbourSensor
from tagmetry.arena.obstacles import Obstacle, blocks
from tagmetry.arena.world_state import RobotState, WorldState
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import BoolArray

_KEPT = 4096  # worlds, for what is told late


@dataclass(frozen=True)
class Neighbour:
    """Another robot as a robot senses it.

    Attributes:
        id: Of the neighbour.
        range_m: From centre to centre.
        bearing_rad: Where it is, from the robot's front, in (-pi, pi].
        relative_heading_rad: Where it heads, from the robot's own heading, in (-pi, pi].
        age_s: Time since the image that this rests on.
    """

    id: int
    range_m: float
    bearing_rad: float
    relative_heading_rad: float
    age_s: float


@dataclass(frozen=True)
class NearObstacle:
    """An obstacle as a robot senses it.

    Attributes:
        name: Of the obstacle.
        range_m: From the robot's centre to its nearest point; 0 inside.
        bearing_rad: Where that point is, from the robot's front, in (-pi, pi].
    """

    name: str
    range_m: float
    bearing_rad: float


@dataclass(frozen=True)
class Told:
    """What a robot is told at one moment: the record of it, too.

    Attributes:
        robot_id: Who is told.
        time_s: When.
        neighbours: The nearest first.
        obstacles: The nearest first.
    """

    robot_id: int
    time_s: float
    neighbours: tuple[Neighbour, ...]
    obstacles: tuple[NearObstacle, ...]


@dataclass
class Neighbourhood:
    """Says what each robot may know.

    Attributes:
        sensor: Of all robots.
        sensors: Of some robots, by id, another one.
        obstacles: Virtual discs and walls.
        radii_m: Of the robots by id, which hide what is behind them.
        seed: Of all random numbers.
    """

    sensor: NeighbourSensor = field(default_factory=NeighbourSensor)
    sensors: Mapping[int, NeighbourSensor] = field(default_factory=dict)
    obstacles: Sequence[Obstacle] = ()
    radii_m: Mapping[int, float] = field(default_factory=dict)
    seed: int = 0

    def __post_init__(self) -> None:
        self._worlds: deque[WorldState] = deque(maxlen=_KEPT)
        self._rngs: dict[int, np.random.Generator] = {}

    def tell(self, world: WorldState) -> tuple[Told, ...]:
        """Return what every robot is told.

        Args:
            world: The robots now; later than the one before.
        """
        self._worlds.append(world)
        return tuple(self._told(robot.id, world.time_s) for robot in world)

    def _told(self, robot_id: int, time_s: float) -> Told:
        sensor = self.sensors.get(robot_id, self.sensor)
        world = self._world_at(time_s - sensor.delay_s)
        own = world.robot(robot_id) if world is not None else None
        if world is None or own is None:
            return Told(robot_id, time_s, (), ())
        late_s = time_s - world.time_s
        rng = self._rngs.setdefault(robot_id, np.random.default_rng([self.seed, robot_id]))
        neighbours = self._neighbours(own, world, sensor, rng, late_s)
        return Told(robot_id, time_s, neighbours, self._near(own, sensor, rng))

    def _world_at(self, time_s: float) -> WorldState | None:
        """Return the newest world that is old enough."""
        return next((one for one in reversed(self._worlds) if one.time_s <= time_s + 1e-9), None)

    def _neighbours(
        self,
        own: RobotState,
        world: WorldState,
        sensor: NeighbourSensor,
        rng: np.random.Generator,
        late_s: float,
    ) -> tuple[Neighbour, ...]:
        others = [other for other in world if other.id != own.id]
        places = np.array([(other.x_m, other.y_m) for other in others]).reshape(-1, 2)
        ranges, bearings = _polar(own, places)
        is_sensed = _within(ranges, bearings, sensor)
        if sensor.line_of_sight:
            is_sensed &= self._in_sight(own, others, places, ranges <= 2 * sensor.range_m)
        found = []
        for k in np.flatnonzero(is_sensed).tolist():
            turn = others[k].heading_rad - own.heading_rad
            seen = sensed(ranges[k], bearings[k], turn, sensor, rng)
            if seen is not None:
                found.append(Neighbour(others[k].id, *seen, others[k].age_s + late_s))
        return tuple(sorted(found, key=lambda one: one.range_m)[: sensor.most])

    def _near(
        self, own: RobotState, sensor: NeighbourSensor, rng: np.random.Generator
    ) -> tuple[NearObstacle, ...]:
        at = np.array([own.x_m, own.y_m])
        points = np.array([one.nearest_point(at) for one in self.obstacles]).reshape(-1, 2)
        ranges, bearings = _polar(own, points)
        found = []
        for k in np.flatnonzero(_within(ranges, bearings, sensor)).tolist():
            seen = sensed(ranges[k], bearings[k], 0.0, sensor, rng)
            if seen is not None:
                found.append(NearObstacle(self.obstacles[k].name, *seen[:2]))
        return tuple(sorted(found, key=lambda one: one.range_m))

    def _in_sight(
        self, own: RobotState, others: Sequence[RobotState], places: Array, is_near: BoolArray
    ) -> BoolArray:
        """Say which of the robots that are near nothing hides, shape (n,)."""
        at = np.array([own.x_m, own.y_m])
        is_hidden = ~is_near
        for k in np.flatnonzero(is_near).tolist():
            between = blocks(at, places, places[k], self.radii_m.get(others[k].id, 0.0))
            between[k] = False
            is_hidden |= between
        for obstacle in self.obstacles:
            is_hidden |= obstacle.hides(at, places)
        return np.asarray(~is_hidden)


def sensed(
    range_m: float,
    bearing_rad: float,
    turn_rad: float,
    sensor: NeighbourSensor,
    rng: np.random.Generator,
) -> tuple[float, float, float] | None:
    """Return range, bearing and relative heading as a sensor gives them; None where it drops out.

    The same count of random numbers is drawn every time, so that runs with and without one fault
    can be compared.
    """
    noise, chance = rng.standard_normal(3), rng.random()
    if chance < sensor.drop_probability:
        return None
    range_sd_m = np.hypot(sensor.range_sd_m, sensor.range_sd_share * range_m)
    noisy_m = max(0.0, float(range_m + range_sd_m * noise[0]))
    bearing = bearing_rad + sensor.bearing_sd_rad * noise[1]
    turn = turn_rad + sensor.heading_sd_rad * noise[2]
    return (
        _rounded(noisy_m, sensor.range_step_m),
        float(wrap_angle_rad(_rounded(bearing, sensor.angle_step_rad))),
        float(wrap_angle_rad(_rounded(turn, sensor.angle_step_rad))),
    )


def _polar(own: RobotState, places: Array) -> tuple[Array, Array]:
    """Return ranges and bearings of places (n, 2) in a robot's frame, each of shape (n,)."""
    x, y = (places - [own.x_m, own.y_m]).T
    return np.hypot(x, y), wrap_angle_rad(np.arctan2(y, x) - own.heading_rad)


def _within(ranges: Array, bearings: Array, sensor: NeighbourSensor) -> BoolArray:
    off = np.abs(wrap_angle_rad(bearings - sensor.view_center_rad))
    is_near, is_ahead = ranges <= sensor.range_m, off <= sensor.view_rad / 2 + 1e-12
    return np.asarray(is_near & is_ahead)


def _rounded(value: float, step: float) -> float:
    return float(np.round(value / step) * step) if step > 0 else float(value)
