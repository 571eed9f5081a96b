"""Of the arena (seed 001)."""

from dataclasses import dataclass


@dataclass(frozen=True)
class FloorError:
    """How far a marker on a floor is from where it is said to be (seed 001, figure 9).

    Attributes:
        method: Whose calibration, detector and place.
        repeat: Which of the calibrations.
        id: Of the marker.
        x_m: Where it is in the world, whose origin is below the camera.
        y_m: The same.
        error_x_m: Said minus true; NaN where it was not found.
        error_y_m: The same.
        sd_m: Root of the trace of the stated covariance; NaN where none is stated.
    """

    method: str
    repeat: int
    id: int
    x_m: float
    y_m: float
    error_x_m: float
    error_y_m: float
    sd_m: float


@dataclass(frozen=True)
class SliderPlace:
    """A marker on a slider that moves and turns (seed 001, figures 11 and 12).

    Attributes:
        method: Whose.
        repeat: Which of the runs.
        time_s: Since it began to move.
        way_m: How far it truly is from where it began.
        turn_rad: By how much it is truly turned since.
        error_m: Of the way, with its sign; NaN where the marker was not found.
        error_rad: Of the turn.
        sd_m: Of the way as it is stated; NaN where none is.
        sd_rad: Of the turn.
    """

    method: str
    repeat: int
    time_s: float
    way_m: float
    turn_rad: float
    error_m: float
    error_rad: float
    sd_m: float
    sd_rad: float


@dataclass(frozen=True)
class Rate:
    """What an image costs with so many robots (seed 001, figure 10).

    Attributes:
        method: Whose.
        robots: How many there are.
        found: How many of them were found in an image, on average.
        cpu_ms: Processor time of an image: the median.
        cpu_p90_ms: What nine of ten images need no more than.
    """

    method: str
    robots: int
    found: float
    cpu_ms: float
    cpu_p90_ms: float


@dataclass(frozen=True)
class FollowingMoment:
    """Leader and follower when an image was measured (seed 001, figures 13 and 14).

    Attributes:
        delay_s: From the middle of an exposure until a command acts.
        slippery: One of the leader's wheels slips once.
        repeat: Which of the drives.
        time_s: Since the simulation began.
        leader_x_m: Where the leader truly is.
        leader_y_m: The same.
        follower_x_m: Where the follower truly is.
        follower_y_m: The same.
        gap_m: From centre to centre, truly.
        seen_gap_m: The same, as the camera tells.
        seen_heading_rad: Of the leader, as the camera tells.
        odometry_heading_rad: Of the leader, as its wheels tell.
        true_heading_rad: Of the leader, when the image was taken.
        touching: Whether the two touch.
    """

    delay_s: float
    slippery: bool
    repeat: int
    time_s: float
    leader_x_m: float
    leader_y_m: float
    follower_x_m: float
    follower_y_m: float
    gap_m: float
    seen_gap_m: float
    seen_heading_rad: float
    odometry_heading_rad: float
    true_heading_rad: float
    touching: bool


@dataclass(frozen=True)
class SwarmPlace:
    """Where one robot of a swarm is, about once a second.

    Attributes:
        task: What the swarm does.
        robots: How many there are.
        repeat: Which of the runs.
        time_s: Since the simulation began.
        robot: Its id.
        x_m: Where it truly is.
        y_m: The same.
        nearest_m: To the nearest other one, from centre to centre.
        off_m: From its place in the formation; NaN where there is none.
        told: Of how many neighbours it was told.
        has_touched: Whether it has touched another one so far.
        cpu_s: Processor time of the whole simulation so far.
    """

    task: str
    robots: int
    repeat: int
    time_s: float
    robot: int
    x_m: float
    y_m: float
    nearest_m: float
    off_m: float
    told: int
    has_touched: bool
    cpu_s: float
