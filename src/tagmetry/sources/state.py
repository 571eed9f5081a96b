"""How a live source is doing, and how patient it is."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

LiveKind = Literal["connecting", "running", "frozen", "lost", "reconnecting", "closed"]


@dataclass(frozen=True)
class LiveState:
    """How a live source is doing.

    Attributes:
        kind: `frozen`: images arrive, but always the same; `lost`: none arrive, an attempt to
            reconnect follows after a pause.
        reason: Why, in words; empty while all is well.
    """

    kind: LiveKind
    reason: str = ""


@dataclass(frozen=True)
class LiveTiming:
    """How patient a live source is.

    Attributes:
        hang_s: An opening or a read that takes longer counts as lost.
        frozen_s: Equal images for longer than this are reported.
        first_pause_s: Before the first attempt to reconnect; doubles with each that fails.
        longest_pause_s: The pauses grow up to this.
    """

    hang_s: float = 12.0  # the drivers' own limits are 5 and 10 s and come with a better reason
    frozen_s: float = 1.0
    first_pause_s: float = 0.5
    longest_pause_s: float = 5.0

    def next_pause_s(self, pause_s: float) -> float:
        """Return the pause after an attempt that failed."""
        return min(2.0 * pause_s, self.longest_pause_s)


OnState = Callable[[LiveState], None]
