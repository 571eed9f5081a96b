"""What the lens room and the page say to each other."""

from dataclasses import dataclass
from typing import Literal

LensPhase = Literal["preparing", "scan", "iterate", "average", "track", "reacquire", "ended"]


@dataclass(frozen=True)
class LensPoint:
    """One image.

    Attributes:
        time_s: When it was taken, in the camera's clock.
        zoom_percent: In effect for it.
        focus: In effect for it, the camera's own unit.
        depth_m: Of the marker; null where it was not seen.
        depth_sd_m: Its standard deviation.
        true_m: The depth as the simulation has it.
    """

    time_s: float
    zoom_percent: float
    focus: float
    depth_m: float
    depth_sd_m: float
    true_m: float


@dataclass(frozen=True)
class LensTrace:
    """What the lens has done so far.

    Attributes:
        phase: Of the newest image.
        points: The newest images, the oldest first.
        images: Since the beginning.
        converged_s: When the first final measurement was there; null before.
        why: Why there is no measurement, or why it ended; empty otherwise.
    """

    phase: LensPhase
    points: tuple[LensPoint, ...]
    images: int
    converged_s: float
    why: str


@dataclass(frozen=True)
class LensPicture:
    """The newest image.

    Attributes:
        width_px: Of the picture as it is sent.
        height_px: Of the picture as it is sent.
        corners_px: Of the marker; empty where it was not seen.
        jpeg: The picture's file; it goes behind the JSON of the others.
    """

    width_px: int
    height_px: int
    corners_px: tuple[tuple[float, float], ...]
    jpeg: bytes


@dataclass(frozen=True)
class StartLens:
    """Look for a simulated 10 mm marker and measure it.

    Attributes:
        depth_m: Where it stands, or about where it moves.
        turn_deg: How far it is turned about its upright axis.
        tracks: It moves to and fro, and is followed.
    """

    depth_m: float
    turn_deg: float
    tracks: bool


@dataclass(frozen=True)
class StopLens:
    """Leave the lens where it is."""
