"""Robots that turn as nobody told them: a motor died, a wheel is caught, a cable is loose.

A robot that turns too little may be weak, or pushes against something; that harms nobody and is not
judged. One that turns more than it was told, or the other way, for a second is stopped for good.
What it was told in the last second counts too: an image shows what was done some time ago.
"""

from collections import deque
from collections.abc import Mapping

from tagmetry.arena import RobotState
from tagmetry.arena.drive import Twist

_EXCESS_RADPS = 1.0
_PATIENCE_S = 1.0
_LATE_S = 1.0


class Obedience:
    """Watches robots that are driven from the host."""

    def __init__(self) -> None:
        self._told: dict[int, deque[tuple[float, float]]] = {}  # by id: when, and what turn, rad/s
        self._since_s: dict[int, float] = {}
        self._faults: dict[int, str] = {}

    @property
    def faults(self) -> Mapping[int, str]:
        """Of robots that did not obey, in words, by id."""
        return self._faults

    def watch(self, state: RobotState, told: Twist) -> None:
        """Compare how a robot moves with what it was told; only while images show it."""
        wanted_radps, turns_radps = told.turn_rate_radps, state.turn_rate_radps
        least_radps = min(
            excess_radps(turns_radps, one) for one in self._recent(state, wanted_radps)
        )
        if state.age_s > 0 or least_radps < _EXCESS_RADPS:
            self._since_s.pop(state.id, None)
            return
        since_s = self._since_s.setdefault(state.id, state.time_s)
        if state.time_s - since_s >= _PATIENCE_S and state.id not in self._faults:
            self._faults[state.id] = (
                f"it turned with {turns_radps:.1f} rad/s where {wanted_radps:.1f} were wanted, "
                f"for {_PATIENCE_S:g} s"
            )

    def _recent(self, state: RobotState, wanted_radps: float) -> list[float]:
        """Return the turns that a robot was told in the last second, with the newest."""
        told = self._told.setdefault(state.id, deque())
        told.append((state.time_s, wanted_radps))
        while told[0][0] < state.time_s - _LATE_S:
            told.popleft()
        return [turn_radps for _, turn_radps in told]


def excess_radps(turns_radps: float, wanted_radps: float) -> float:
    """Return by how much a robot turns more than wanted; the other way all of it is too much."""
    along_radps = turns_radps if wanted_radps >= 0 else -turns_radps
    return max(along_radps - abs(wanted_radps), -along_radps)
