"""How a robot moves before its wheels can have said so: what it was told, after its motors' lag.

A command acts some time after it was sent; by then the wheels' own word is old by the whole way of
the radio. A controller that must know its own motion until its next command acts takes the commands
instead (O. J. M. Smith's predictor): each wheel follows with a first-order lag.
"""

from math import exp

from tagmetry.arena.drive import STILL, Twist


class OwnMotion:
    """One robot's motion as its commands imply it."""

    def __init__(self, lag_s: float = 0.05) -> None:
        """Begin at rest; `lag_s` is the time constant of its motors."""
        self._lag_s = lag_s
        self._wanted = self._moving = STILL
        self._time_s: float | None = None

    def at(self, time_s: float) -> Twist:
        """Return the motion at a moment, not before the last one asked for."""
        if self._time_s is not None and time_s > self._time_s:
            left = exp(-(time_s - self._time_s) / self._lag_s)
            self._moving = _between(self._wanted, self._moving, left)
        self._time_s = time_s if self._time_s is None else max(time_s, self._time_s)
        return self._moving

    def command(self, twist: Twist, acts_s: float) -> None:
        """Take in what it is told, from the moment on that it acts."""
        self.at(acts_s)
        self._wanted = twist


def _between(end: Twist, start: Twist, left: float) -> Twist:
    return Twist(
        end.speed_mps + left * (start.speed_mps - end.speed_mps),
        end.turn_rate_radps + left * (start.turn_rate_radps - end.turn_rate_radps),
    )
