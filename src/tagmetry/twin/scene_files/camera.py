"""The camera of a scene file: where it is, its lens, its shutter, its sensor.

camera:
  size_px: [1280, 720]
  field_of_view_deg: 60
  at: {translation_m: [0, -2, 1], looking_at_m: [0, 0, 1]}
  optics: {blur_px: 0.6, vignetting: 0.5}
  sensor: {full_well_e: 10000, read_noise_e: 6}
"""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.errors import InputError
from tagmetry.files import load_camera
from tagmetry.files.checked import OwnFileModel
from tagmetry.twin.optics.digital_zoom import Interpolation
from tagmetry.twin.optics.response import Curve, Gamma, Hdr, Linear, Response, Srgb
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import Vignetting
from tagmetry.twin.rendering.crop import DigitalZoom
from tagmetry.twin.rendering.shot import Optics, Shot, Shutter
from tagmetry.twin.scene_files.fields import (
    Length,
    NotNegative,
    Pair,
    Positive,
    Share,
    SizePx,
)
from tagmetry.twin.scene_files.place import MovingPlace, WaypointPath, path_of

_Angle = Annotated[float, Field(gt=0, lt=175)]
_Bits = Annotated[int, Field(ge=8, le=16)]
_Quality = Annotated[int, Field(ge=1, le=100)]
_Blur = Annotated[float, Field(ge=0, le=50)]


class _ThinLens(OwnFileModel):
    """A lens that focuses."""

    focal: Length
    f_number: Positive
    pixel: Length
    focus: Length

    def lens(self) -> ThinLens:
        """Return the lens."""
        return ThinLens.from_f_number(self.focal, self.f_number, self.pixel)


class _Optics(OwnFileModel):
    """How the image is formed."""

    blur_px: _Blur = 0.6
    vignetting: Share = 0.0
    vignetting_radial: list[float] = []  # noqa: RUF012 (pydantic copies it)
    veil: Annotated[float, Field(ge=0, lt=1)] = 0.0
    thin_lens: _ThinLens | None = None

    def optics(self) -> Optics:
        """Return the optics."""
        vignetting = Vignetting(self.vignetting, tuple(self.vignetting_radial))
        if self.thin_lens is None:
            return Optics(self.blur_px, vignetting=vignetting, veil=self.veil)
        lens = self.thin_lens.lens()
        lens.image_distance_m(self.thin_lens.focus)  # refuses what it cannot focus on
        return Optics(self.blur_px, lens, self.thin_lens.focus, vignetting, self.veil)


class _Shutter(OwnFileModel):
    """When light is taken in."""

    exposure_s: NotNegative = 0.0
    line_s: NotNegative = 0.0


class _Response(OwnFileModel):
    """The curve from light to grey values."""

    kind: Literal["linear", "gamma", "srgb", "hdr", "curve"]
    exponent: Positive = 2.2
    stops: NotNegative = 4.0
    knee: Positive = 0.25
    exposures: list[float] = []  # noqa: RUF012 (pydantic copies it)
    codes: list[float] = []  # noqa: RUF012

    def response(self) -> Response:
        """Return the curve."""
        match self.kind:
            case "gamma":
                return Gamma(self.exponent)
            case "srgb":
                return Srgb()
            case "hdr":
                return Hdr(self.stops, self.knee)
            case "curve":
                return Curve(tuple(self.exposures), tuple(self.codes))
        return Linear()


class _Sensor(OwnFileModel):
    """How light becomes grey values."""

    bits: _Bits = 8
    full_well_e: Positive | None = 12_000.0
    read_noise_e: NotNegative = 8.0
    gain: Positive = 1.0
    black_level: Annotated[float, Field(ge=0, lt=1)] = 0.0
    noise_grey: NotNegative = 0.0
    jpeg_quality: _Quality | None = None
    response: _Response = _Response(kind="linear")

    def sensor(self) -> Sensor:
        """Return the sensor."""
        return Sensor(
            self.bits,
            self.full_well_e,
            self.read_noise_e if self.full_well_e is not None else 0.0,
            self.gain,
            self.black_level,
            self.response.response(),
            self.noise_grey,
            self.jpeg_quality,
        )


class _Zoom(OwnFileModel):
    """What is given out of the sensor's image."""

    factor: Annotated[float, Field(ge=1)] = 1.0
    size_px: SizePx | None = None
    interpolation: Interpolation = "linear"

    def zoom(self) -> DigitalZoom:
        """Return the zoom."""
        width_px, height_px = self.size_px or (None, None)
        return DigitalZoom(self.factor, width_px, height_px, self.interpolation)


class _Lens(OwnFileModel):
    """Distortion, as OpenCV counts its coefficients."""

    kind: Literal["brown", "fisheye"] = "brown"
    coefficients: list[float]

    def lens(self) -> Lens:
        """Return the lens."""
        given = tuple(map(float, self.coefficients))
        return FisheyeLens(given) if self.kind == "fisheye" else BrownLens(given)


class CameraTable(OwnFileModel):
    """The whole camera; its intrinsics from a file, or from size and focal length."""

    file: str | None = None
    size_px: SizePx | None = None
    focal_px: Positive | None = None
    field_of_view_deg: _Angle | None = None
    center_px: Pair | None = None
    lens: _Lens | None = None
    at: MovingPlace | None = None
    path: WaypointPath | None = None
    optics: _Optics = _Optics()
    shutter: _Shutter = _Shutter()
    sensor: _Sensor = _Sensor()
    zoom: _Zoom = _Zoom()
    brightness: Positive = 0.85

    def shot(self) -> Shot:
        """Return the camera about to take its first picture."""
        return Shot(
            self._camera(),
            path_of(self.at, self.path, is_camera=True),
            optics=self.optics.optics(),
            shutter=Shutter(self.shutter.exposure_s, self.shutter.line_s),
            sensor=self.sensor.sensor(),
            zoom=self.zoom.zoom(),
            brightness=self.brightness,
        )

    def _camera(self) -> Camera:
        inline = (self.size_px, self.focal_px, self.field_of_view_deg, self.center_px, self.lens)
        if self.file is not None:
            if any(one is not None for one in inline):
                raise InputError("give the camera's `file`, or its size_px and so on, not both")
            return load_camera(self.file)
        if self.size_px is None:
            raise InputError("expected size_px, as [1280, 720], or the `file` of a camera")
        width_px, height_px = self.size_px
        center_px = self.center_px or [(width_px - 1) / 2, (height_px - 1) / 2]
        lens = self.lens.lens() if self.lens is not None else BrownLens()
        focal_px = (self._focal_px(width_px),) * 2
        return Camera(width_px, height_px, focal_px, (center_px[0], center_px[1]), lens)

    def _focal_px(self, width_px: int) -> float:
        """Return the focal length, given or from the field of view across, without distortion."""
        if (self.focal_px is None) == (self.field_of_view_deg is None):
            raise InputError("give one of focal_px and field_of_view_deg")
        if self.focal_px is not None:
            return self.focal_px
        half_rad = np.radians(self.field_of_view_deg or 0.0) / 2
        if self.lens is not None and self.lens.kind == "fisheye":
            return float(width_px / 2 / half_rad)
        return float(width_px / 2 / np.tan(half_rad))
