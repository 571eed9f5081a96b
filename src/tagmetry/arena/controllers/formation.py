"""A shape that robots keep by their neighbours only."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import hypot, sin
from typing import Self

from tagmetry.arena.controllers.manner import Manner, driven
from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place
from tagmetry.arena.told import Neighbour

_BRISK = Manner(speed_mps=0.3)


@dataclass(frozen=True)
class Formation:
    """Keep a shape: every robot holds its place beside those of the shape that it senses.

    The shape turns with the robots' common heading: each place is told in the frame of one of them
    and turned by that neighbour's relative heading.

    Attributes:
        places: Of every robot by id, in the shape's own frame.
        leader: Moves by itself; the shape follows it.
        manner: How the others move.
    """

    places: Mapping[int, Place]
    leader: int
    manner: Manner = _BRISK

    def __call__(self, view: View) -> Twist:
        """Return how to move; still where it senses nobody of its shape."""
        own = self.places.get(view.robot)
        known = [one for one in view.neighbours if one.id in self.places]
        if own is None or not known:
            return STILL
        chosen = view.neighbour(self.leader)
        spots = [self._spot(own, one) for one in ([chosen] if chosen else self._before(own, known))]
        x_m = sum(spot.x_m for spot in spots) / len(spots)
        y_m = sum(spot.y_m for spot in spots) / len(spots)
        if hypot(x_m, y_m) < 0.01:  # in its place: turn as the others do
            return Twist(0.0, self.manner.turn_per_s * sin(spots[0].heading_rad))
        return driven(x_m, y_m, self.manner)

    def _before(self, own: Place, known: list[Neighbour]) -> list[Neighbour]:
        """Return those whose places are nearer to the leader's; all where nobody's is.

        Who also heeds those behind waits for them, and a long formation tears.
        """
        lead = self.places[self.leader]
        own_m = own.distance_m(lead) - 1e-6
        return [one for one in known if self.places[one.id].distance_m(lead) < own_m] or known

    def _spot(self, own: Place, neighbour: Neighbour) -> Place:
        """Return the robot's own place of the shape, as a neighbour tells it, in its own frame."""
        there = Place(neighbour.x_m, neighbour.y_m, neighbour.relative_heading_rad)
        return there @ own.seen_from(self.places[neighbour.id])

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""
        return (self.manner.parameter,)

    def tuned(self, name: str, value: float) -> Self:  # noqa: ARG002 - it has one
        """Return it with one of its parameters changed."""
        return replace(self, manner=self.manner.at_speed(value))
