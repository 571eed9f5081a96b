"""Of a mobile robot (seed 004)."""

from dataclasses import dataclass


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
