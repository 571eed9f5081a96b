"""What the server tells of itself: who a page is, pictures, and how all does."""

from dataclasses import dataclass
from typing import Literal

from tagmetry.live.messages.robots import LiveMarker

Role = Literal["viewer", "operator"]


@dataclass(frozen=True)
class Welcome:
    """The first message on every connection: who you are, and what there is.

    Attributes:
        role: What this page may do.
        scenarios: That can be chosen.
        floor_m: Half the floor's extent along x and y.
        beat_s: How often a page that drives says that it is there.
    """

    role: Role
    scenarios: tuple[str, ...]
    floor_m: tuple[float, float]
    beat_s: float


@dataclass(frozen=True)
class Picture:
    """What the camera sees; on its way the JPEG follows the JSON in one binary message.

    Attributes:
        time_s: When it was taken, in the arena's clock.
        taken_s: The same in a clock of the server; `Seen` tells it back.
        width_px: Of the picture as it is sent.
        height_px: Of the picture as it is sent.
        markers: That were found in it.
        jpeg: The picture.
    """

    time_s: float
    taken_s: float
    width_px: int
    height_px: int
    markers: tuple[LiveMarker, ...]
    jpeg: bytes


@dataclass(frozen=True)
class StageTime:
    """How long one step of an image's way takes.

    Attributes:
        name: As people call it.
        mean_s: The mean of the last second.
    """

    name: str
    mean_s: float


@dataclass(frozen=True)
class Health:
    """How the measurement does.

    Attributes:
        scenario: What runs.
        image_rate_hz: Images measured per second of the wall's clock.
        late_s: How far the arena is behind the wall's clock.
        turn_s: Time that one image takes, the mean of the last second.
        picture_rate_hz: Pictures made per second.
        picture_age_s: Since the newest picture was taken; None before.
        viewers: Pages that are connected.
        recording: Name of the file that is being written; None while nothing is.
        notice: What went wrong last; empty while all is well.
        stages: The steps of an image's way.
        worst_loss: Share of packets that do not arrive, of the robot that loses most.
        least_battery_v: Of the robot that has least; None before one told.
        memory_bytes: That the arena's program holds; None where the system does not say.
        disk_free_bytes: Where recordings go; None where that is not known.
        dropped_count: What the recording could not write in time.
        advice: What is wrong and what to do, a line each; none while all is well.
    """

    scenario: str
    image_rate_hz: float
    late_s: float
    turn_s: float
    picture_rate_hz: float
    picture_age_s: float | None
    viewers: int
    recording: str | None
    notice: str
    stages: tuple[StageTime, ...]
    worst_loss: float
    least_battery_v: float | None
    memory_bytes: int | None
    disk_free_bytes: int | None
    dropped_count: int
    advice: tuple[str, ...]


@dataclass(frozen=True)
class Delivery:
    """How messages reach the pages.

    Attributes:
        pages: That are connected.
        told_hz: Messages per second that pages took, all together.
        missed_hz: Messages per second that a newer one replaced before a slow page took them.
        shown_median_s: From an image until a page shows its picture, the newest 200 times, as
            pages say; None before.
        shown_p99_s: What 99 of 100 do not exceed.
    """

    pages: int
    told_hz: float
    missed_hz: float
    shown_median_s: float | None
    shown_p99_s: float | None


@dataclass(frozen=True)
class FloorErrors:
    """How far measured places are off over the floor, as `MeasureErrors` found it.

    Attributes:
        is_measuring: It is being found out; nothing is known yet.
        step_m: Between the places.
        height_m: Of the markers above the floor.
        errors: One for each place: x, y, the error along x and along y, and the stated standard
            deviation, m.
    """

    is_measuring: bool
    step_m: float
    height_m: float
    errors: tuple[tuple[float, float, float, float, float], ...]


@dataclass(frozen=True)
class Refused:
    """What the page asked for last was not done.

    Attributes:
        why: In words.
    """

    why: str
