"""What the board doctor says."""

from dataclasses import dataclass
from typing import Literal

from tagmetry.markers import Board


@dataclass(frozen=True, eq=False)
class BoardAdvice:
    """One thing about a board that is not as it was asked for.

    Attributes:
        severity: `problem`: no or a wrong calibration follows; `hint`: a guess, or of little harm.
        title: A few words.
        expected: What was asked for.
        found: What the pictures show, with its numbers.
        remedy: What to do, beside asking for `board`.
        board: The board to ask for instead, where that is known.
    """

    severity: Literal["problem", "hint"]
    title: str
    expected: str
    found: str
    remedy: str = ""
    board: Board | None = None

    def __str__(self) -> str:
        """Return it as one sentence."""
        told = f"{self.title}: expected {self.expected}, found {self.found}"
        return f"{told}; {self.remedy}" if self.remedy else told
