"""What each robot may know: its neighbours and the obstacles near it, in its own frame.

A robot's frame has x forward and y to its left; a bearing is counter-clockwise from its front, and
a relative heading is the neighbour's heading minus its own. Every robot has a sensor and random
numbers of its own, so that what one is told does not depend on who else there is.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from tagmetry.arena.neighbour_sensor import NeighbourSensor
from tagmetry.arena.obstacles import Obstacle, between
from tagmetry.arena.world_state import WorldState
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


@dataclass(frozen=True, eq=False)
class _Crowd:
    """The robots of a world as arrays."""

    world: WorldState

    @cached_property
    def rows(self) -> Mapping[int, int]:
        """Of the robots, by id."""
        return {robot.id: row for row, robot in enumerate(self.world.robots)}

    @cached_property
    def places(self) -> Array:
        """(x, y, heading), shape (n, 3)."""
        numbers = [(one.x_m, one.y_m, one.heading_rad) for one in self.world.robots]
        return np.array(numbers, dtype=np.float64).reshape(-1, 3)

    @cached_property
    def polar(self) -> tuple[Array, Array]:
        """Ranges and bearings of all robots (columns) from each (rows), each of shape (n, n)."""
        return _polar(self.places[:, None, :], self.places[None, :, :2])


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
        self._crowds: deque[_Crowd] = deque(maxlen=_KEPT)
        self._rngs: dict[int, np.random.Generator] = {}

    def tell(self, world: WorldState) -> tuple[Told, ...]:
        """Return what every robot is told.

        Args:
            world: The robots now; later than the one before.
        """
        self._crowds.append(_Crowd(world))
        return tuple(self._told(robot.id, world.time_s) for robot in world)

    def sensor_of(self, robot_id: int) -> NeighbourSensor:
        """Return the sensor that a robot has."""
        return self.sensors.get(robot_id, self.sensor)

    def _told(self, robot_id: int, time_s: float) -> Told:
        sensor = self.sensor_of(robot_id)
        crowd = self._crowd_at(time_s - sensor.delay_s)
        if crowd is None or robot_id not in crowd.rows:
            return Told(robot_id, time_s, (), ())
        if robot_id not in self._rngs:
            self._rngs[robot_id] = np.random.default_rng([self.seed, robot_id])
        row, rng = crowd.rows[robot_id], self._rngs[robot_id]
        neighbours = self._neighbours(crowd, row, sensor, rng, time_s)
        return Told(robot_id, time_s, neighbours, self._near(crowd.places[row], sensor, rng))

    def _crowd_at(self, time_s: float) -> _Crowd | None:
        """Return the newest that is old enough."""
        late = reversed(self._crowds)
        return next((one for one in late if one.world.time_s <= time_s + 1e-9), None)

    def _neighbours(
        self,
        crowd: _Crowd,
        row: int,
        sensor: NeighbourSensor,
        rng: np.random.Generator,
        time_s: float,
    ) -> tuple[Neighbour, ...]:
        own, robots = crowd.places[row], crowd.world.robots
        ranges, bearings = (values[row] for values in crowd.polar)
        is_sensed = _within(ranges, bearings, sensor)
        is_sensed[row] = False
        if sensor.line_of_sight:
            is_sensed &= self._in_sight(crowd, row, ranges <= 2 * sensor.range_m)
        which = np.flatnonzero(is_sensed)
        turns = crowd.places[which, 2] - own[2]
        told = sensed(np.stack([ranges[which], bearings[which], turns], axis=-1), sensor, rng)
        late_s = time_s - crowd.world.time_s
        found = [
            Neighbour(robots[k].id, values[0], values[1], values[2], robots[k].age_s + late_s)
            for k, values in zip(which.tolist(), told.tolist(), strict=True)
            if values[0] == values[0]  # NaN dropped out
        ]
        return tuple(sorted(found, key=lambda one: one.range_m)[: sensor.most])

    def _near(
        self, own: Array, sensor: NeighbourSensor, rng: np.random.Generator
    ) -> tuple[NearObstacle, ...]:
        if not self.obstacles:
            return ()
        points = np.array([one.nearest_point(own[:2]) for one in self.obstacles])
        ranges, bearings = _polar(own, points)
        which = np.flatnonzero(_within(ranges, bearings, sensor))
        asked = np.stack([ranges[which], bearings[which], np.zeros(len(which))], axis=-1)
        found = [
            NearObstacle(self.obstacles[k].name, values[0], values[1])
            for k, values in zip(which.tolist(), sensed(asked, sensor, rng).tolist(), strict=True)
            if values[0] == values[0]
        ]
        return tuple(sorted(found, key=lambda one: one.range_m))

    def _in_sight(self, crowd: _Crowd, row: int, is_near: BoolArray) -> BoolArray:
        """Say which of the robots that are near nothing hides, shape (n,)."""
        which = np.flatnonzero(is_near)
        which = which[which != row]
        own, places = crowd.places[row, :2], crowd.places[which, :2]
        radii = [self.radii_m.get(crowd.world.robots[k].id, 0.0) for k in which.tolist()]
        hides = between(own, places, places, np.array(radii))
        np.fill_diagonal(hides, val=False)
        is_hidden = hides.any(axis=1)
        for obstacle in self.obstacles:
            is_hidden |= obstacle.hides(own, places)
        in_sight = np.zeros(len(is_near), dtype=bool)
        in_sight[which] = ~is_hidden
        return in_sight


def sensed(exact: Array, sensor: NeighbourSensor, rng: np.random.Generator) -> Array:
    """Return what a sensor gives, NaN where it drops out.

    The same count of random numbers is drawn whatever the faults are, so that runs with and without
    one of them can be compared.

    Args:
        exact: Ranges, bearings and relative headings, shape (n, 3), m and rad.
        sensor: Its faults.
        rng: Where the noise comes from.
    """
    noise, chance = rng.standard_normal(exact.shape), rng.random(len(exact))
    deviations = np.empty(exact.shape)
    deviations[:, 0] = np.hypot(sensor.range_sd_m, sensor.range_sd_share * exact[:, 0])
    deviations[:, 1:] = sensor.bearing_sd_rad, sensor.heading_sd_rad
    noisy = exact + deviations * noise
    noisy[:, 0] = _rounded(np.maximum(noisy[:, 0], 0.0), sensor.range_step_m)
    noisy[:, 1:] = wrap_angle_rad(_rounded(noisy[:, 1:], sensor.angle_step_rad))
    noisy[chance < sensor.drop_probability] = np.nan
    return np.asarray(noisy)


def _polar(own: Array, places: Array) -> tuple[Array, Array]:
    """Return ranges and bearings of places (..., 2) from (x, y, heading) (..., 3)."""
    x, y = np.moveaxis(places - own[..., :2], -1, 0)
    return np.hypot(x, y), wrap_angle_rad(np.arctan2(y, x) - own[..., 2])


def _within(ranges: Array, bearings: Array, sensor: NeighbourSensor) -> BoolArray:
    off = np.abs(wrap_angle_rad(bearings - sensor.view_center_rad))
    is_near, is_ahead = ranges <= sensor.range_m, off <= sensor.view_rad / 2 + 1e-12
    return np.asarray(is_near & is_ahead)


def _rounded(values: Array, step: float) -> Array:
    return np.asarray(np.round(values / step) * step) if step > 0 else values
