"""How often something happened in the last second, and how long it took."""

import time
from collections import deque

_WINDOW_S = 1.0


class Rate:
    """Counts events, in the wall's clock."""

    def __init__(self) -> None:
        self._events: deque[tuple[float, float]] = deque(maxlen=1000)

    def count(self, took_s: float = 0.0) -> None:
        """Count one event that took so long."""
        self._events.append((time.monotonic(), took_s))

    @property
    def per_s(self) -> float:
        """Events in the last second."""
        return len(self._recent()) / _WINDOW_S

    @property
    def mean_s(self) -> float:
        """How long one took in the mean; 0 where there was none."""
        recent = self._recent()
        return sum(recent) / len(recent) if recent else 0.0

    def _recent(self) -> list[float]:
        since_s = time.monotonic() - _WINDOW_S
        return [took_s for at_s, took_s in tuple(self._events) if at_s >= since_s]
