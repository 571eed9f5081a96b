"""How the camera of a scene file makes a picture: optics, shutter, sensor, digital zoom."""

from typing import Annotated, Literal

from pydantic import Field

from tagmetry.files.checked import OwnFileModel
from tagmetry.twin.optics.digital_zoom import Interpolation
from tagmetry.twin.optics.response import Curve, Gamma, Hdr, Linear, Response, Srgb
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import Vignetting
from tagmetry.twin.rendering.crop import DigitalZoom
from tagmetry.twin.rendering.shot import Optics, Shutter
from tagmetry.twin.scene_files.fields import Length, NotNegative, Positive, Share, SizePx

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


class OpticsTable(OwnFileModel):
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


class ShutterTable(OwnFileModel):
    """When light is taken in."""

    exposure_s: NotNegative = 0.0
    line_s: NotNegative = 0.0

    def shutter(self) -> Shutter:
        """Return the shutter."""
        return Shutter(self.exposure_s, self.line_s)


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


class SensorTable(OwnFileModel):
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


class ZoomTable(OwnFileModel):
    """What is given out of the sensor's image."""

    factor: Annotated[float, Field(ge=1)] = 1.0
    size_px: SizePx | None = None
    interpolation: Interpolation = "linear"

    def zoom(self) -> DigitalZoom:
        """Return the zoom."""
        width_px, height_px = self.size_px or (None, None)
        return DigitalZoom(self.factor, width_px, height_px, self.interpolation)
