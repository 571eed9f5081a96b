"""What a controller gets and gives: the same on a simulated robot and on a real one.

A controller is anything that turns what one robot knows at a moment into how it shall move:

    def control(view: View) -> Twist

One that has to remember is an object with `__call__`; every robot gets one of its own.
"""

from collections.abc import Callable
from dataclasses import dataclass

from tagmetry.arena.drive import Twist
from tagmetry.arena.place import Place
from tagmetry.arena.told import NearObstacle, Neighbour


@dataclass(frozen=True)
class View:
    """What one robot knows at one moment.

    Attributes:
        robot: Its id.
        time_s: Now, in the arena's clock.
        twist: How it moves, by its own wheels.
        neighbours: The robots that its sensor reaches, as they stood at `sensed_s`.
        obstacles: The obstacles that its sensor reaches.
        place: Where it is in the world, carried on to now; None where the arena does not tell.
        sensed_s: When neighbours and obstacles stood so; now when None.
    """

    robot: int
    time_s: float
    twist: Twist
    neighbours: tuple[Neighbour, ...] = ()
    obstacles: tuple[NearObstacle, ...] = ()
    place: Place | None = None
    sensed_s: float | None = None

    def neighbour(self, robot: int) -> Neighbour | None:
        """Return one neighbour; None where it is not seen."""
        return next((one for one in self.neighbours if one.id == robot), None)


Controller = Callable[[View], Twist]
