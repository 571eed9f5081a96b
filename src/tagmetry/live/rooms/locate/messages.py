"""What the locate room and the page say to each other."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LocateMarker:
    """A marker of the map.

    Attributes:
        id: Of its family.
        left_m: Its left end from above, (x, y) in the world.
        right_m: Its right end.
    """

    id: int
    left_m: tuple[float, float]
    right_m: tuple[float, float]


@dataclass(frozen=True)
class LocatePoint:
    """Where the camera was.

    Attributes:
        x_m: In the world.
        y_m: In the world.
        z_m: Above the floor.
        heading_rad: Where it looks, from the world's x, counter-clockwise.
        ellipse: Of (x, y), one standard deviation: long and short half axis, m, and the long
            one's direction, rad.
        sd_m: Standard deviations of x, y and z.
        sd_rad: Of the turns about x, y and z.
        true_m: (x, y, z) as the simulation has it; None where nobody knows.
        mahalanobis2: Squared error by its covariance, six numbers together; 6 on average;
            None where the truth is not known.
    """

    x_m: float
    y_m: float
    z_m: float
    heading_rad: float
    ellipse: tuple[float, float, float]
    sd_m: tuple[float, float, float]
    sd_rad: tuple[float, float, float]
    true_m: tuple[float, float, float] | None
    mahalanobis2: float | None


@dataclass(frozen=True)
class LocateResidual:
    """What a marker of the newest image says.

    Attributes:
        id: Of its family.
        distance_m: From the camera.
        rms_px: Between its corners and where the pose puts them.
        is_used: The pose rests on it.
        why: Why not; empty where it does.
    """

    id: int
    distance_m: float
    rms_px: float
    is_used: bool
    why: str


@dataclass(frozen=True)
class LocateTrace:
    """How a camera found its way.

    Attributes:
        is_running: Images still come.
        markers: The map.
        path: The newest places, the oldest first.
        residuals: Of the newest image.
        why: Why the newest image has no place, or why it ended; empty otherwise.
    """

    is_running: bool
    markers: tuple[LocateMarker, ...]
    path: tuple[LocatePoint, ...]
    residuals: tuple[LocateResidual, ...]
    why: str


@dataclass(frozen=True)
class StartLocate:
    """Carry a simulated camera round a room with markers on its walls.

    Attributes:
        noise_px: Standard deviation of every corner's coordinate.
    """

    noise_px: float


@dataclass(frozen=True)
class LocateImages:
    """Say where a camera was from images that it took; all lie in the server's folder of maps.

    Attributes:
        map_name: Of the marker map's file.
        camera: Of the intrinsics' file.
        images: Of a recording, a video, or a folder of pictures.
    """

    map_name: str
    camera: str
    images: str


@dataclass(frozen=True)
class StopLocate:
    """Stop it."""
