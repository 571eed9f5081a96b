"""What is planned: a camera, a marker before it, and what the picture will be like."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np

from tagmetry.calibrate.quality.places import Place, poses_at
from tagmetry.camera import Camera
from tagmetry.detect.photometric.bound import Print
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import MarkerFamily, family, marker_corners_m

_MIDDLE_GREY = 115.0
_MOST = 1e6  # of any noise, blur, exposure and speed that is worth a plan
_ROUNDING_GREY = 1 / np.sqrt(12)


@dataclass(frozen=True)
class Imaging:
    """What a picture is like.

    Attributes:
        noise_grey: Standard deviation of a pixel's noise, grey values of 255.
        black_grey: Grey value of ink.
        white_grey: Grey value of paper.
        blur_px: Standard deviation of the point spread, besides the pixel's own square.
        exposure_s: For how long light is taken in.
    """

    noise_grey: float = 2.0
    black_grey: float = 40.0
    white_grey: float = 190.0
    blur_px: float = 0.6
    exposure_s: float = 0.01

    def __post_init__(self) -> None:
        for name in ("noise_grey", "blur_px", "exposure_s"):
            _check(name, getattr(self, name), least=0.0)
        if not 0 < self.black_grey < self.white_grey <= 255:
            raise InputError(
                f"expected grey values 0 < black < white <= 255, got {self.black_grey} and "
                f"{self.white_grey}"
            )

    @classmethod
    def of_contrast(
        cls, contrast_grey: float, noise_grey: float, blur_px: float, exposure_s: float
    ) -> Self:
        """Return a picture whose paper is lighter than its ink by so much, about a middle grey."""
        black_grey, white_grey = (_MIDDLE_GREY + k * contrast_grey / 2 for k in (-1, 1))
        return cls(noise_grey, black_grey, white_grey, blur_px, exposure_s)

    @property
    def all_noise_grey(self) -> float:
        """The noise with that of rounding to whole grey values."""
        return float(np.hypot(self.noise_grey, _ROUNDING_GREY))

    @property
    def signal_to_noise(self) -> float:
        """The difference of paper and ink by the noise."""
        return (self.white_grey - self.black_grey) / self.all_noise_grey


@dataclass(frozen=True, eq=False)
class Setup:
    """A marker before a camera.

    Attributes:
        camera: Intrinsics; where they have a covariance, its part of the error is told.
        size_m: Side of the marker's black square.
        distance_m: From the camera to its centre.
        tilt_deg: Between its normal and the line to the camera.
        direction_deg: To which side of the picture its face is turned: 0 right, 90 down.
        pixel: Where its centre is seen; None for the middle of the image.
        family: Its family, or the name of one.
        speed_m_s: How fast it moves, along the image's rows.
        size_sd_m: Standard deviation of its side, as it was measured on paper.
        imaging: What the picture is like.
    """

    camera: Camera
    size_m: float
    distance_m: float
    tilt_deg: float = 30.0
    direction_deg: float = 0.0
    pixel: tuple[float, float] | None = None
    family: str | MarkerFamily = "tag36h11"
    speed_m_s: float = 0.0
    size_sd_m: float = 5e-5
    imaging: Imaging = field(default_factory=Imaging)

    def __post_init__(self) -> None:
        _check("size_m", self.size_m)
        _check("distance_m", self.distance_m)
        _check("speed_m_s", self.speed_m_s, least=0.0)
        _check("size_sd_m", self.size_sd_m, least=0.0)
        if not 0 <= self.tilt_deg <= 85:
            raise InputError(f"tilt_deg must be from 0 to 85 degrees, got {self.tilt_deg}")
        if not np.isfinite(self.direction_deg):
            raise InputError(f"direction_deg must be finite, got {self.direction_deg}")

    @cached_property
    def T_camera_marker(self) -> RigidTransform:  # noqa: N802 (a frame's name)
        """Where the marker is."""
        width_px, height_px = self.camera.size_px
        pixel = self.pixel or ((width_px - 1) / 2, (height_px - 1) / 2)
        place = Place(pixel, self.distance_m, self.tilt_deg, self.direction_deg)
        return poses_at(self.camera, [place])[0]

    @cached_property
    def p_camera(self) -> Array:
        """The marker's corners in the camera frame, shape (4, 3), metres."""
        return np.asarray(self.T_camera_marker.apply(marker_corners_m(self.size_m)))

    @cached_property
    def corners_px(self) -> Array:
        """Where they are seen, shape (4, 2); NaN for what the lens does not show."""
        return self.camera.project(self.p_camera)

    @property
    def fits(self) -> bool:
        """The image shows all four corners."""
        return bool(self.camera.contains(self.corners_px).all())

    @property
    def short_side_px(self) -> float:
        """Length of the shortest of its sides, or of its height over one."""
        following = np.roll(self.corners_px, -1, axis=0)
        sides = following - self.corners_px
        area = 0.5 * abs(_cross(self.corners_px, following).sum())
        lengths = np.linalg.norm(sides, axis=1)
        return float(min(lengths.min(), area / lengths.max()))

    @property
    def motion_px(self) -> tuple[float, float]:
        """How far its centre moves in the image during the exposure, right and down."""
        centre = np.asarray(self.T_camera_marker.translation)
        _, by_point = self.camera.project_with_jacobian(centre)
        right, down = by_point[:, 0] * self.speed_m_s * self.imaging.exposure_s
        return float(right), float(down)

    @property
    def marker_family(self) -> MarkerFamily:
        """The marker's family."""
        return family(self.family) if isinstance(self.family, str) else self.family

    @property
    def printed(self) -> Print:
        """The picture of the family's first marker, and how it is seen."""
        kind, look = self.marker_family, self.imaging
        return Print(
            kind.picture(0),
            kind.layout.margin_cells,
            look.black_grey,
            look.white_grey,
            look.blur_px,
            motion_px=self.motion_px,
        )


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _check(name: str, value: float, least: float | None = None) -> None:
    """Raise InputError unless a value is positive, or finite and at least something."""
    if least is None and not (np.isfinite(value) and value > 0):
        raise InputError(f"{name} must be positive, got {value}")
    if least is not None and not (np.isfinite(value) and value >= least):
        raise InputError(f"{name} must be at least {least:g}, got {value}")
    if value > _MOST:
        raise InputError(f"{name} must be at most {_MOST:g}, got {value}")
