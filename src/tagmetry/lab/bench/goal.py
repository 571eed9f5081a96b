"""One thing that is to hold, and whether it does."""

from dataclasses import dataclass
from typing import Literal

Verdict = Literal["holds", "falls short", "beyond the bound"]


@dataclass(frozen=True)
class Goal:
    """One thing that is to hold.

    Attributes:
        name: What is asked, with the case.
        measured: In this run.
        wanted: The limit.
        at_least: The limit is the least, and not the most.
        bound: What nobody can get below, where that is known.
    """

    name: str
    measured: float
    wanted: float
    at_least: bool = False
    bound: float | None = None

    @property
    def holds(self) -> bool:
        """Whether it does."""
        if self.at_least:
            return self.measured >= self.wanted
        return self.measured <= self.wanted

    @property
    def verdict(self) -> Verdict:
        """Whether it holds, in words; what no detector could reach is told apart."""
        if self.holds:
            return "holds"
        cannot = self.bound is not None and self.bound > self.wanted
        return "beyond the bound" if cannot else "falls short"
