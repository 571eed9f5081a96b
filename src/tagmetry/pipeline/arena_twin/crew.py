"""The robots' computers, as the simulated arena sees them: in this process, or each in its own."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Acts:
    """What the robots' computers did in one tick.

    Attributes:
        packets: That they sent, robot after robot in the scenario's order.
        wheels_radps: How fast the left and right wheels shall turn, shape (n, 2).
    """

    packets: tuple[bytes, ...]
    wheels_radps: Array


class Crew(Protocol):
    """The computers of all robots."""

    @property
    def faults(self) -> Mapping[int, str]:
        """What failed on robots, in words, by id; empty while all do well."""

    def bring(self, robot_id: int, packet: bytes) -> None:
        """Let a packet arrive at a robot, before its next tick."""

    def act(self, counts: NDArray[np.int64], now_us: int) -> Acts:
        """Let all robots' computers do one tick's work.

        Args:
            counts: Of the left and right wheels' encoders, shape (n, 2).
            now_us: The robots' clock.
        """

    def close(self) -> None:
        """Switch them off."""
