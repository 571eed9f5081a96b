"""Which counters of a session were heard already: a window that slides with the highest one.

Reference: RFC 4303, section 3.4.3, anti-replay window.
"""

WIDTH = 1024  # packets may overtake each other by so many


class ReplayWindow:
    """Accepts every counter once; those that lie too far back never."""

    def __init__(self) -> None:
        self._highest = 0  # counters begin at 1
        self._heard = 0  # bit n: the counter n below the highest was heard
        self._count = 0

    @property
    def highest(self) -> int:
        """The highest counter heard; 0 before the first."""
        return self._highest

    @property
    def count(self) -> int:
        """How many were heard in all."""
        return self._count

    def is_new(self, counter: int) -> bool:
        """Say whether this counter may still come."""
        if counter > self._highest:
            return True
        back = self._highest - counter
        return counter > 0 and back < WIDTH and not self._heard >> back & 1

    def add(self, counter: int) -> None:
        """Remember a counter that is new."""
        ahead = counter - self._highest
        if ahead > 0:
            kept = self._heard << ahead if ahead < WIDTH else 0
            self._heard = kept & (1 << WIDTH) - 1 | 1
            self._highest = counter
        else:
            self._heard |= 1 << -ahead
        self._count += 1

    def loss(self) -> float:
        """Return the fraction of the last counters that were not heard, 0 before the first."""
        expected = min(self._highest, WIDTH)
        return 1.0 - self._heard.bit_count() / expected if expected else 0.0
