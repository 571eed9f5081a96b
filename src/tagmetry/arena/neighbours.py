"""What each robot may know: its neighbours and the obstacles near it, in its own frame.

A robot's frame has x forward and y to its left; a bearing is counter-clockwise from its front, and
a relative heading is the neighbour's heading minus its own. Every robot has a sensor and random
numbers of its own, so that what one is told does not depend on who else there is.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import isnan

import numpy as np

from tagmetry.arena.crowd import Crowd, polar
from tagmetry.arena.neighbour_sensor import NeighbourSensor
from tagmetry.arena.obstacles import Obstacle, between
from tagmetry.arena.reach import within_reach
from tagmetry.arena.told import NearObstacle, Told
from tagmetry.arena.world_state import WorldState
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import BoolArray, IntArray

_KEPT = 4096  # worlds, for what is told late


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
        self._crowds: deque[Crowd] = deque(maxlen=_KEPT)
        self._rngs: dict[int, np.random.Generator] = {}

    def tell(self, world: WorldState) -> tuple[Told, ...]:
        """Return what every robot is told.

        Args:
            world: The robots now; later than the one before.
        """
        self._crowds.append(Crowd(world))
        self._forget(world.time_s)
        told: dict[int, Told] = {}
        for sensor, ids in self._by_sensor(world).items():
            told |= self._told(sensor, ids, world.time_s)
        return tuple(told[robot.id] for robot in world)

    def _by_sensor(self, world: WorldState) -> Mapping[NeighbourSensor, Sequence[int]]:
        """Return the ids of the robots that have each sensor."""
        if not self.sensors:
            return {self.sensor: [robot.id for robot in world]}
        found: dict[NeighbourSensor, list[int]] = {}
        for robot in world:
            found.setdefault(self.sensor_of(robot.id), []).append(robot.id)
        return found

    def sensor_of(self, robot_id: int) -> NeighbourSensor:
        """Return the sensor that a robot has."""
        return self.sensors.get(robot_id, self.sensor)

    def _forget(self, time_s: float) -> None:
        """Forget what is older than the latest sensor tells of."""
        sensors = (self.sensor, *self.sensors.values())
        since_s = time_s - max(one.delay_s for one in sensors)
        while len(self._crowds) > 1 and self._crowds[1].world.time_s <= since_s:
            self._crowds.popleft()

    def _told(self, sensor: NeighbourSensor, ids: Sequence[int], time_s: float) -> dict[int, Told]:
        """Return what robots with a sensor are told, by id."""
        crowd = self._crowd_at(time_s - sensor.delay_s)
        known = [one for one in ids if crowd is not None and one in crowd.rows]
        told = {one: Told.nothing(one, time_s) for one in ids} if len(known) < len(ids) else {}
        if crowd is None or not known:
            return told
        neighbours = self._neighbours(crowd, known, sensor, time_s)
        for robot_id, sensed_ones in zip(known, neighbours, strict=True):
            near = self._near(crowd.places[crowd.rows[robot_id]], sensor, robot_id)
            told[robot_id] = Told(robot_id, time_s, sensed_ones, near)
        return told

    def _crowd_at(self, time_s: float) -> Crowd | None:
        """Return the newest that is old enough."""
        late = reversed(self._crowds)
        return next((one for one in late if one.world.time_s <= time_s + 1e-9), None)

    def _neighbours(
        self, crowd: Crowd, ids: Sequence[int], sensor: NeighbourSensor, time_s: float
    ) -> list[Array]:
        """Return whom each of some robots senses, the nearest first, as `Told.sensed`."""
        rows = np.array([crowd.rows[one] for one in ids])
        view = float(sensor.view_center_rad), float(sensor.view_rad)
        who, whom, exact = within_reach(crowd.places, rows, float(sensor.range_m), view)
        if sensor.line_of_sight:
            is_seen = self._seen(crowd, rows, 2 * sensor.range_m)[who, whom]
            who, whom, exact = who[is_seen], whom[is_seen], exact[is_seen]
        draws = self._draws(ids, np.bincount(who, minlength=len(ids)).tolist(), sensor)
        told = sensed(exact, sensor, *draws)
        order = np.lexsort((told[:, 0], who))
        order = order[~np.isnan(told[order, 0])]  # the others dropped out
        ages_s = crowd.ages_s[whom[order]] + (time_s - crowd.world.time_s)
        rest = np.column_stack([crowd.ids[whom[order]], told[order], ages_s])
        ends = np.searchsorted(who[order], np.arange(len(ids) + 1)).tolist()
        return [rest[first:last][: sensor.most] for first, last in pairwise(ends)]

    def _seen(self, crowd: Crowd, rows: IntArray, near_m: float) -> BoolArray:
        """Say which of all robots (columns) nothing hides from those of some rows, shape (m, n)."""
        ranges = [polar(crowd.places[row], crowd.places[:, :2])[0] for row in rows]
        return np.array(
            [
                self._in_sight(crowd, row, away_m <= near_m)
                for row, away_m in zip(rows.tolist(), ranges, strict=True)
            ]
        )

    def _near(self, own: Array, sensor: NeighbourSensor, robot_id: int) -> tuple[NearObstacle, ...]:
        if not self.obstacles:
            return ()
        points = np.array([one.nearest_point(own[:2]) for one in self.obstacles])
        ranges, bearings = polar(own, points)
        which = np.flatnonzero(_within(ranges, bearings, sensor))
        asked = np.stack([ranges[which], bearings[which], np.zeros(len(which))], axis=-1)
        told = sensed(asked, sensor, *self._draws([robot_id], [len(which)], sensor))
        found = [
            NearObstacle(self.obstacles[k].name, values[0], values[1])
            for k, values in zip(which.tolist(), told.tolist(), strict=True)
            if not isnan(values[0])
        ]
        return tuple(sorted(found, key=lambda one: one.range_m))

    def _draws(
        self, ids: Sequence[int], counts: Sequence[int], sensor: NeighbourSensor
    ) -> tuple[Array, Array]:
        """Return random numbers for so many readings of each robot: normal (n, 3), even (n,).

        The same count is drawn whatever a sensor's faults are, so that runs with and without one of
        them can be compared; a sensor without any needs none.
        """
        if sensor.is_exact:
            return np.zeros((sum(counts), 3)), np.ones(sum(counts))
        rngs = [self._rng(robot_id) for robot_id in ids]
        draws = [
            (rng.standard_normal((count, 3)), rng.random(count))
            for rng, count in zip(rngs, counts, strict=True)
        ]
        normal, even = zip(*draws, strict=True)
        return np.concatenate(normal), np.concatenate(even)

    def _rng(self, robot_id: int) -> np.random.Generator:
        if robot_id not in self._rngs:
            self._rngs[robot_id] = np.random.default_rng([self.seed, robot_id])
        return self._rngs[robot_id]

    def _in_sight(self, crowd: Crowd, row: int, is_near: BoolArray) -> BoolArray:
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


def sensed(exact: Array, sensor: NeighbourSensor, normal: Array, even: Array) -> Array:
    """Return what a sensor gives, NaN where it drops out.

    Args:
        exact: Ranges, bearings and relative headings, shape (n, 3), m and rad.
        sensor: Its faults.
        normal: Random numbers of a normal distribution, shape (n, 3).
        even: Random numbers from 0 to 1, shape (n,).
    """
    deviations = np.empty(exact.shape)
    deviations[:, 0] = np.hypot(sensor.range_sd_m, sensor.range_sd_share * exact[:, 0])
    deviations[:, 1:] = sensor.bearing_sd_rad, sensor.heading_sd_rad
    noisy = exact + deviations * normal
    noisy[:, 0] = _rounded(np.maximum(noisy[:, 0], 0.0), sensor.range_step_m)
    noisy[:, 1:] = wrap_angle_rad(_rounded(noisy[:, 1:], sensor.angle_step_rad))
    noisy[even < sensor.drop_probability] = np.nan
    return np.asarray(noisy)


def _within(ranges: Array, bearings: Array, sensor: NeighbourSensor) -> BoolArray:
    off = np.abs(wrap_angle_rad(bearings - sensor.view_center_rad))
    is_near, is_ahead = ranges <= sensor.range_m, off <= sensor.view_rad / 2 + 1e-12
    return np.asarray(is_near & is_ahead)


def _rounded(values: Array, step: float) -> Array:
    return np.asarray(np.round(values / step) * step) if step > 0 else values
