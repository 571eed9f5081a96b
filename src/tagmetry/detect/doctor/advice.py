"""What the doctor says."""

from dataclasses import dataclass
from typing import Literal

Severity = Literal["problem", "hint", "ok"]


@dataclass(frozen=True)
class Advice:
    """One thing that the doctor has to say about an image.

    Attributes:
        severity: `problem`: keeps markers from being found or measured; `hint`: a guess, or of
            little harm; `ok`: as it should be.
        title: A few words.
        explanation: What was seen, with its numbers.
        remedy: What to do; empty where nothing needs doing.
    """

    severity: Severity
    title: str
    explanation: str
    remedy: str = ""
