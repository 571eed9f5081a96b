"""The value of a control over time: commands, each of which it follows at a finite speed."""

from dataclasses import dataclass

import numpy as np

_SAME_S = 1e-9  # moments nearer than this are one
_KEPT_S = 10.0  # how far back the past is asked for


@dataclass(frozen=True)
class _Move:
    """From a moment on, from where it was towards a value."""

    time_s: float
    start: float
    target: float


class Course:
    """Where a value is at any time, past or to come."""

    def __init__(self, value: float, speed_per_s: float = np.inf) -> None:
        """Begin at rest.

        Args:
            value: Where.
            speed_per_s: How fast it moves when told to; infinite is at once.
        """
        self._speed_per_s = speed_per_s
        self._moves = [_Move(-np.inf, value, value)]

    def go(self, target: float, time_s: float) -> None:
        """Head for a value from a moment on; what was to begin later is forgotten."""
        start = self.at(time_s)
        earlier = [move for move in self._moves if move.time_s < time_s - _SAME_S]
        self._moves = [*_recent(earlier, time_s), _Move(time_s, start, target)]

    def at(self, time_s: float) -> float:
        """Return where it is."""
        move = self._move_at(time_s)
        way = self._speed_per_s * max(time_s - move.time_s, 0.0) if self._is_slow else np.inf
        return float(move.start + np.clip(move.target - move.start, -way, way))

    def rests_at(self, time_s: float) -> bool:
        """Say whether it is where it was last told to go, with nothing to come."""
        return self.at(time_s) == self._moves[-1].target

    @property
    def _is_slow(self) -> bool:
        return bool(np.isfinite(self._speed_per_s))

    def _move_at(self, time_s: float) -> _Move:
        return next(m for m in reversed(self._moves) if m.time_s <= time_s + _SAME_S)


def _recent(moves: list[_Move], time_s: float) -> list[_Move]:
    """Return the moves that matter from some time ago on."""
    past = sum(move.time_s < time_s - _KEPT_S for move in moves)
    return moves[max(past - 1, 0) :]
