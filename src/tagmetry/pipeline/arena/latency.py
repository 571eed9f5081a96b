"""How long it took from an image to what came of it: the newest so many times."""

from collections import deque
from dataclasses import dataclass, field

import numpy as np

_KEPT = 10_000


@dataclass
class Latency:
    """Collects durations, and tells their median and their tail."""

    _times_s: deque[float] = field(default_factory=lambda: deque(maxlen=_KEPT))

    def add(self, time_s: float) -> None:
        """Take one more."""
        self._times_s.append(time_s)

    def __len__(self) -> int:
        """How many are kept."""
        return len(self._times_s)

    def quantile_s(self, share: float) -> float:
        """Return the time that this share of the images took no longer than; NaN without any."""
        return float(np.quantile(self._times_s, share)) if self._times_s else float("nan")

    @property
    def told(self) -> str:
        """Median and 99th percentile in words."""
        if not self._times_s:
            return "no image yet"
        middle_ms, tail_ms = 1000 * self.quantile_s(0.5), 1000 * self.quantile_s(0.99)
        return f"{middle_ms:.1f} ms (median), {tail_ms:.1f} ms (99 %)"
