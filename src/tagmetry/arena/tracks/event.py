"""What happens to a robot's track, for people and for the record."""

from dataclasses import dataclass
from typing import Literal

EventKind = Literal["found", "lost", "jumped", "swapped"]


@dataclass(frozen=True)
class TrackEvent:
    """Something that happened to a track.

    Attributes:
        kind: `found`: seen for the first time, or again after it was lost; `lost`: not seen for
            so long that its track ended; `jumped`: seen at a place that it cannot have driven to;
            `swapped`: the same, and the place is where another robot was that is not there now.
        robot_id: Which robot.
        time_s: When.
        told: In words.
    """

    kind: EventKind
    robot_id: int
    time_s: float
    told: str
