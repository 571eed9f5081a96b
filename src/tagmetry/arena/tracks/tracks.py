"""The robots followed over time: a filter for each on place, heading, speed and turn rate.

move (to the image's time) -> choose (one sighting for each robot) -> gate (does it fit?) -> update,
begin, or claim (several that agree but do not fit: the robot was carried).

What does not fit, but is no farther away than a push or a slip would bring a robot in that time,
begins its track anew at once.

The time between images is the true one, whatever it is. A robot that is not seen is carried on by
its motion, with a covariance that grows, until `forget_s`.
"""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.arena.sighting import Roster, Sightings
from tagmetry.arena.tracks.claims import Claims
from tagmetry.arena.tracks.event import EventKind, TrackEvent
from tagmetry.arena.tracks.motion import Motion
from tagmetry.arena.tracks.table import TrackTable, innovations
from tagmetry.arena.world_state import RobotState, WorldState
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import BoolArray, IntArray

_LONGEST_PUSH_S = 0.1


@dataclass(frozen=True)
class TrackRules:
    """When a sighting is believed, and when a track ends.

    Attributes:
        gate: Squared Mahalanobis distance, of three numbers, up to which a sighting fits its
            track; 25 is one right one in 65,000 passed over.
        images_to_believe: How many sightings that do not fit, but agree, it takes to be believed.
        forget_s: For how long a robot that is not seen is carried on.
        pushed_mps: How fast a robot may be pushed or slip in any direction.
        pushed_radps: How fast it may be turned so.
    """

    gate: float = 25.0
    images_to_believe: int = 3
    forget_s: float = 2.0
    pushed_mps: float = 2.0
    pushed_radps: float = 12.0

    def __post_init__(self) -> None:
        if not (self.gate > 0 and self.images_to_believe >= 1 and 0 < self.forget_s < np.inf):
            raise InputError(f"gate, images_to_believe and forget_s must be positive, got {self}")
        if not (self.pushed_mps >= 0 and self.pushed_radps >= 0):
            raise InputError(f"pushed_mps and pushed_radps must not be negative, got {self}")


@dataclass
class Tracks:
    """Follows the robots of a roster.

    Attributes:
        roster: The robots.
        motion: How they move.
        rules: What is believed.
    """

    roster: Roster
    motion: Motion = field(default_factory=Motion)
    rules: TrackRules = field(default_factory=TrackRules)

    def __post_init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget everything: what comes next is of another time."""
        self._table = TrackTable.empty(len(self.roster))
        self._claims = Claims.none(len(self.roster))
        self._time_s: float | None = None

    def take(self, seen: Sightings, time_s: float) -> tuple[TrackEvent, ...]:
        """Follow the robots to the time of an image; return what happened to tracks.

        Args:
            seen: The robots that the image shows.
            time_s: When it was taken; later than the one before.

        Raises:
            InputError: Time stands still or runs backwards.
        """
        self._move_to(time_s)
        lost = self._table.has_track & (time_s - self._table.seen_s > self.rules.forget_s)
        self._table = self._table.dropped(lost)
        events = self._events("lost", np.flatnonzero(lost), time_s)
        seen, fits = self._chosen(seen)
        is_new = ~self._table.has_track[seen.rows]
        self._begin(seen.at(is_new), time_s)
        events += self._events("found", seen.rows[is_new], time_s)
        self._update(seen.at(fits & ~is_new), time_s)
        odd = seen.at(~fits & ~is_new)
        is_near = self._is_within_a_push(odd, time_s)
        self._begin(odd.at(is_near), time_s)
        return tuple(events + self._claim(odd.at(~is_near), time_s))

    def world(self, time_s: float | None = None) -> WorldState:
        """Return the state of all robots that have a track.

        Args:
            time_s: The moment, such as that of sending; of the last image when None. Before the
                last image is not told.

        Raises:
            InputError: The moment is before the last image.
        """
        if self._time_s is None:
            return WorldState(time_s if time_s is not None else 0.0, ())
        time_s = self._time_s if time_s is None else time_s
        if not time_s >= self._time_s:
            raise InputError(
                f"the state can be told for {self._time_s} s, the last image, or later, not for "
                f"{time_s}"
            )
        table = self._table
        if time_s > self._time_s:
            table = table.moved(self.motion, time_s - self._time_s)
        rows = np.flatnonzero(table.has_track)
        states = self._states(table, rows, time_s)
        return WorldState(time_s, tuple(sorted(states, key=lambda one: one.id)))

    def _move_to(self, time_s: float) -> None:
        if not np.isfinite(time_s):
            raise InputError(f"time_s must be finite, got {time_s}")
        if self._time_s is not None:
            if time_s <= self._time_s:
                raise InputError(
                    f"time_s must rise from image to image, got {time_s} after {self._time_s}; "
                    "call reset() before images of another time"
                )
            self._table = self._table.moved(self.motion, time_s - self._time_s)
            self._claims = self._claims.moved(self.motion, time_s - self._time_s)
        self._time_s = time_s

    def _chosen(self, seen: Sightings) -> tuple[Sightings, BoolArray]:
        """Return one sighting for each robot, the one that fits best, and which of them fit.

        A robot without a track whose marker is seen twice is not begun.
        """
        distances2 = self._table.distances2(seen.rows, seen.places, seen.noise)
        times = np.bincount(seen.rows, minlength=len(self.roster))[seen.rows]
        usable = self._table.has_track[seen.rows] | (times == 1)
        order = np.lexsort((distances2, seen.rows))
        order = order[usable[order]]
        _, firsts = np.unique(seen.rows[order], return_index=True)
        best = order[firsts]
        return seen.at(best), np.asarray(distances2[best] <= self.rules.gate)

    def _is_within_a_push(self, seen: Sightings, time_s: float) -> BoolArray:
        """Say of sightings whether they are as near to their tracks as a push would bring them."""
        off = innovations(self._table.means[seen.rows], seen.places)
        since_s = np.minimum(time_s - self._table.seen_s[seen.rows], _LONGEST_PUSH_S)
        is_near = np.hypot(off[:, 0], off[:, 1]) <= self.rules.pushed_mps * since_s
        return np.asarray(is_near & (np.abs(off[:, 2]) <= self.rules.pushed_radps * since_s))

    def _begin(self, seen: Sightings, time_s: float) -> None:
        if len(seen):
            self._table = self._table.begun(seen.rows, seen.places, seen.noise, seen.common, time_s)
            self._claims = self._claims.without(seen.rows)

    def _update(self, seen: Sightings, time_s: float) -> None:
        if len(seen):
            self._table = self._table.updated(
                seen.rows, seen.places, seen.noise, seen.common, time_s
            )
            self._claims = self._claims.without(seen.rows)

    def _claim(self, seen: Sightings, time_s: float) -> list[TrackEvent]:
        """Pass sightings over that do not fit, or believe those that agree with those before."""
        if not len(seen):
            return []
        self._claims = self._claims.with_more(seen, time_s, self.rules.gate)
        is_believed = self._claims.counts[seen.rows] >= self.rules.images_to_believe
        believed = seen.at(is_believed)
        events = [
            self._moved_event(believed.at(np.array([k])), time_s) for k in range(len(believed))
        ]
        self._begin(believed, time_s)
        return events

    def _moved_event(self, seen: Sightings, time_s: float) -> TrackEvent:
        """Return what happened to a robot that is suddenly elsewhere."""
        robot, place = self.roster.robots[seen.rows[0]], seen.places[0]
        away = np.hypot(*(self._table.means[:, :2] - place[:2]).T)
        radii = np.array([other.radius_m for other in self.roster.robots])
        others = (away < radii) & (self._table.seen_s < time_s)
        others[seen.rows] = False
        there = f"({place[0]:.3f}, {place[1]:.3f}) m"
        if others.any():
            other = self.roster.robots[int(np.flatnonzero(others)[0])]
            told = f"{robot.name} is at {there}, where {other.name} was; were they swapped?"
            return TrackEvent("swapped", robot.id, time_s, told)
        told = f"{robot.name} is suddenly at {there}; was it carried?"
        return TrackEvent("jumped", robot.id, time_s, told)

    def _events(self, kind: EventKind, rows: IntArray, time_s: float) -> list[TrackEvent]:
        words = {"found": "is seen", "lost": f"was not seen for {self.rules.forget_s:g} s"}
        robots = [self.roster.robots[row] for row in rows.tolist()]
        return [TrackEvent(kind, one.id, time_s, f"{one.name} {words[kind]}") for one in robots]

    def _states(self, table: TrackTable, rows: IntArray, time_s: float) -> list[RobotState]:
        """Return the states of some robots at the table's time."""
        covariances = table.covariances[rows]
        covariances[:, :3, :3] += table.common[rows]
        is_seen = (table.seen_s[rows] == self._time_s).tolist()
        ages_s = (time_s - table.seen_s[rows]).tolist()
        robots = [self.roster.robots[row] for row in rows.tolist()]
        of_each = zip(robots, table.means[rows].tolist(), covariances, ages_s, is_seen, strict=True)
        return [
            RobotState(robot.id, robot.name, x, y, heading, speed, rate, own, age_s, seen, time_s)
            for robot, (x, y, heading, speed, rate), own, age_s, seen in of_each
        ]
