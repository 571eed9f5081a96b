"""The rows of results that experiments write and conclusions read."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """A number that a calibration gives (seed 003, tables 3 to 6).

    Attributes:
        method: Whose calibration.
        repeat: Which of its repeats.
        name: What it is, with its unit unless it is a number of the camera.
        value: What came out.
        true: What it truly is; NaN where there is no truth.
        sd: Its standard deviation as the method states it; NaN where it states none.
    """

    method: str
    repeat: int
    name: str
    value: float
    true: float
    sd: float


@dataclass(frozen=True)
class Position:
    """A marker's coordinate along one axis of the camera (seed 003, tables 7 to 15).

    Attributes:
        method: Whose calibration, detector and pose.
        repeat: Which of the calibrations.
        assumed: What was taken to be true: "right", or what was wrong about it.
        table: Number of the paper's table.
        row: Its row, from 0.
        actual_cm: Where the marker truly is.
        measured_cm: Where it is said to be; NaN where it was not found.
        sd_cm: Standard deviation as the method states it; NaN where it states none.
    """

    method: str
    repeat: int
    assumed: str
    table: int
    row: int
    actual_cm: float
    measured_cm: float
    sd_cm: float


@dataclass(frozen=True)
class Localization:
    """How far a camera's pose is off (seed 002).

    Attributes:
        method: Whose.
        layout: Which markers there are.
        look: What the pictures are like.
        distance_m: From the camera to the middle of the markers.
        yaw_deg: Of the camera.
        pitch_deg: Of the markers.
        roll_deg: Of the markers.
        zone: Of the picture that the middle of the markers is in, 0 to 8; -1 where it is not
            moved about.
        assumed: What was taken to be true: "right", or what was wrong about it.
        repeat: Which picture.
        radial_m: Distance from the true place; NaN where no pose was found.
        xy_m: Of it, along the world's x and y.
        z_m: Of it, along the world's z, with its sign.
        angle_rad: Mean of the errors of yaw, pitch and roll, as the paper counts.
        turn_rad: Angle of the rotation between the estimate and the truth.
        sd_radial_m: Root of the trace of the place's stated covariance; NaN where none is stated.
        sd_angle_rad: Mean of the stated standard deviations about the three axes.
        mahalanobis2: Squared Mahalanobis distance of the error, about 6 where the stated
            covariance is right.
        probability: Of the pose, against its alternatives; NaN where none is stated.
    """

    method: str
    layout: str
    look: str
    distance_m: float
    yaw_deg: float
    pitch_deg: float
    roll_deg: float
    zone: int
    assumed: str
    repeat: int
    radial_m: float
    xy_m: float
    z_m: float
    angle_rad: float
    turn_rad: float
    sd_radial_m: float
    sd_angle_rad: float
    mahalanobis2: float
    probability: float


@dataclass(frozen=True)
class Limit:
    """What an engine made of a picture of markers.

    Attributes:
        engine: Its name.
        variable: What is varied.
        value: To what.
        repeat: Which picture.
        expected: How many markers there are.
        found: How many of them it found.
        false_positives: What else it found.
        corner_rms_px: Root mean square error of a corner's coordinate; NaN where none was found.
        bound_px: The least that the noise allows.
        distance2: Mean squared Mahalanobis distance of the corners, about 8 where the stated
            covariance is right; NaN where none is stated.
        position_percent: Median error of the markers' places, of their distances.
        angle_deg: Median error of their rotations.
        flips: How many have the wrong one of two poses.
        failure: Why there is nothing: it crashed, or did not answer; empty where it did.
    """

    engine: str
    variable: str
    value: float
    repeat: int
    expected: int
    found: int
    false_positives: int
    corner_rms_px: float
    bound_px: float
    distance2: float
    position_percent: float
    angle_deg: float
    flips: int
    failure: str


@dataclass(frozen=True)
class RobotPlace:
    """How far a robot's place on the floor is off (seed 004).

    Attributes:
        method: Whose.
        camera: Which camera.
        layout: Which markers there are.
        size_m: Their side.
        distance_m: From the robot to the wall; 0 where it stands in a corner of the room.
        place: Which of the places in the corner, from 0; -1 before a wall.
        window: How many times brighter than paper the window beside the markers is; 0 is none.
        repeat: Which picture.
        x_m: Error along the world's x; NaN where no place was found.
        y_m: Along y.
        heading_rad: Of the heading.
        sd_place_m: Root of the trace of the place's stated covariance; NaN where none is stated.
        sd_heading_rad: Stated standard deviation of the heading.
        mahalanobis2: Squared Mahalanobis distance of the three errors, about 3 where the stated
            covariance is right.
        markers: How many markers it rests on.
    """

    method: str
    camera: str
    layout: str
    size_m: float
    distance_m: float
    place: int
    window: float
    repeat: int
    x_m: float
    y_m: float
    heading_rad: float
    sd_place_m: float
    sd_heading_rad: float
    mahalanobis2: float
    markers: int


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
class Followed:
    """How far a moving camera's pose is off in one image (seed 002's markers).

    Attributes:
        method: Whose; `filter` joins the images over time.
        layout: Which markers there are.
        distance_m: From the camera to the markers where it began.
        repeat: Which way.
        image: Number of the image on the way.
        gap_s: Time since the image before.
        radial_m: Distance from the true place; NaN where no pose was found.
        turn_rad: Angle of the rotation between the estimate and the truth.
        mahalanobis2: Squared Mahalanobis distance of the error; NaN where none is stated.
        surprise2: Squared innovation by its covariance, 6 on average; NaN but for the filter, and
            for an image that it did not heed.
    """

    method: str
    layout: str
    distance_m: float
    repeat: int
    image: int
    gap_s: float
    radial_m: float
    turn_rad: float
    mahalanobis2: float
    surprise2: float
