"""What an arena shows to pages."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tagmetry.live.show.seeing import EyeKind


@dataclass(frozen=True)
class Programme:
    """What is on when it begins, and what can be asked for.

    Attributes:
        scenario: A ready-made one, or a controller's file by its name.
        robots: How many.
        recordings: Folder for what is recorded.
        controllers: Files of users that can be chosen.
        pictures: Show what the camera sees.
        eye: What is measured: corners with noise, or pictures by the detector.
    """

    scenario: str
    robots: int
    recordings: Path
    controllers: Sequence[Path] = ()
    pictures: bool = True
    eye: EyeKind = "corners"
