"""Of a camera that is localized (seed 002)."""

from dataclasses import dataclass


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
