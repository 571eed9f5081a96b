"""Robots that turn as nobody told them: a motor died, a wheel is caught, a cable is loose.

A robot that turns too little may be weak, or pushes against something; that harms nobody and is not
judged. One that turns more than it was told, or the other way, for a second is stopped for good.
"""

from collections.abc import Mapping

from tagmetry.arena import RobotState
from tagmetry.arena.drive import Twist

_EXCESS_RADPS = 1.0
_PATIENCE_S = 1.0


class Obedience:
    """Watches robots that are driven from the host."""

    def __init__(self) -> None:
        self._since_s: dict[int, float] = {}
        self._faults: dict[int, str] = {}

    @property
    def faults(self) -> Mapping[int, str]:
        """Of robots that did not obey, in words, by id."""
        return self._faults

    def watch(self, state: RobotState, told: Twist) -> None:
        """Compare how a robot moves with what it was told; only while images show it."""
        wanted_radps, turns_radps = told.turn_rate_radps, state.turn_rate_radps
        if state.age_s > 0 or excess_radps(turns_radps, wanted_radps) < _EXCESS_RADPS:
            self._since_s.pop(state.id, None)
            return
        since_s = self._since_s.setdefault(state.id, state.time_s)
        if state.time_s - since_s >= _PATIENCE_S and state.id not in self._faults:
            self._faults[state.id] = (
                f"it turned with {turns_radps:.1f} rad/s where {wanted_radps:.1f} were wanted, "
                f"for {_PATIENCE_S:g} s"
            )


def excess_radps(turns_radps: float, wanted_radps: float) -> float:
    """Return by how much a robot turns more than wanted; the other way all of it is too much."""
    along_radps = turns_radps if wanted_radps >= 0 else -turns_radps
    return max(along_radps - abs(wanted_radps), -along_radps)
