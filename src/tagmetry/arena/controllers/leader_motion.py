"""How a robot's neighbour moves, from what the robot senses of it and from its own wheels.

The robot keeps a frame of its own by its wheels. A sighting may be old: it is put into that frame
from where the robot was then, filtered there (place and velocity, alpha and beta), and
carried on to now along the circle that its heading's rate says. So a delay costs no lag while the
neighbour moves steadily.
"""

from collections import deque
from dataclasses import dataclass
from math import hypot

from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import Twist
from tagmetry.arena.place import Place, turned_rad
from tagmetry.arena.told import Neighbour

_KEPT = 400  # own places, for sightings up to some seconds old


@dataclass(frozen=True)
class Seen:
    """A neighbour as it is now, as far as one can tell.

    Attributes:
        place: In the robot's frame of now.
        twist: How it moves, in its own frame.
    """

    place: Place
    twist: Twist


class NeighbourMotion:
    """What one robot knows of one neighbour."""

    def __init__(self, place_share: float = 0.5, motion_share: float = 0.25) -> None:
        """Begin without a sighting.

        Args:
            place_share: Of a sighting's surprise that goes to the place and the heading, alpha.
            motion_share: That goes to the speed and the turn rate, beta.
        """
        self._alpha, self._beta = place_share, motion_share
        self._own: deque[tuple[float, Place]] = deque(maxlen=_KEPT)
        self._sighted_s: float | None = None
        self._place = Place(0.0, 0.0, 0.0)
        self._twist = Twist(0.0, 0.0)

    def see(self, view: View, neighbour: Neighbour | None) -> Seen | None:
        """Take in a moment; return the neighbour as of now, None before the first sighting."""
        self._drive_on(view)
        if neighbour is not None:
            sensed_s = view.time_s if view.sensed_s is None else view.sensed_s
            self._take_in(sensed_s, _relative(neighbour))
        if self._sighted_s is None:
            return None
        ahead_s = view.time_s - self._sighted_s
        now = _carried(self._place, self._twist, ahead_s)
        return Seen(now.seen_from(self._own[-1][1]), self._twist)

    def _drive_on(self, view: View) -> None:
        if not self._own:
            self._own.append((view.time_s, Place(0.0, 0.0, 0.0)))
            return
        before_s, place = self._own[-1]
        self._own.append((view.time_s, _carried(place, view.twist, view.time_s - before_s)))

    def _take_in(self, time_s: float, relative: Place) -> None:
        seen = self._own_at(time_s) @ relative
        if self._sighted_s is None:
            self._sighted_s, self._place = time_s, seen
            return
        step_s = time_s - self._sighted_s
        if step_s <= 1e-6:
            return
        expected = _carried(self._place, self._twist, step_s)
        off = seen.seen_from(expected)
        self._place = expected @ Place(
            self._alpha * off.x_m, self._alpha * off.y_m, self._alpha * off.heading_rad
        )
        self._twist = Twist(
            self._twist.speed_mps + self._beta * off.x_m / step_s,
            self._twist.turn_rate_radps + self._beta * off.heading_rad / step_s,
        )
        self._sighted_s = time_s

    def _own_at(self, time_s: float) -> Place:
        """Return where the robot was, between its own readings."""
        later = self._own[-1]
        for earlier in reversed(self._own):
            if earlier[0] <= time_s:
                return _between(earlier, later, time_s)
            later = earlier
        return self._own[0][1]


def _relative(neighbour: Neighbour) -> Place:
    ahead = Place(0.0, 0.0, neighbour.bearing_rad).moved(neighbour.range_m, 0.0)
    return Place(ahead.x_m, ahead.y_m, neighbour.relative_heading_rad)


def _carried(place: Place, twist: Twist, time_s: float) -> Place:
    return place.moved(twist.speed_mps * time_s, twist.turn_rate_radps * time_s)


def _between(earlier: tuple[float, Place], later: tuple[float, Place], time_s: float) -> Place:
    span_s = later[0] - earlier[0]
    share = min((time_s - earlier[0]) / span_s, 1.0) if span_s > 0 else 0.0
    step = later[1].seen_from(earlier[1])
    length_m = hypot(step.x_m, step.y_m) * (1 if step.x_m >= 0 else -1)
    return earlier[1].moved(share * length_m, share * turned_rad(step.heading_rad))
