"""How long something took, over the newest times that it happened."""

from collections import deque

import numpy as np

_KEPT = 200
_MOST_S = 60.0  # what says more was never meant


class Delays:
    """The newest delays; to be used from one thread."""

    def __init__(self) -> None:
        self._kept_s: deque[float] = deque(maxlen=_KEPT)

    def count(self, delay_s: float) -> None:
        """Take one; what cannot be is passed over."""
        if 0 <= delay_s <= _MOST_S:
            self._kept_s.append(delay_s)

    def quantile_s(self, share: float) -> float | None:
        """Return what a share of the delays does not exceed; None before the first."""
        return float(np.quantile(self._kept_s, share)) if self._kept_s else None
