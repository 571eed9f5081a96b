"""What a lens and a sensor do to light, each effect against its closed form."""

from tagmetry.twin.optics.digital_zoom import Interpolation, zoomed_pixels
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.optics.response import Curve, Gamma, Hdr, Linear, Response, Srgb
from tagmetry.twin.optics.sensor import Sensor, developed
from tagmetry.twin.optics.spread import Spread
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import Vignetting

__all__ = [
    "Curve",
    "Gamma",
    "Hdr",
    "Interpolation",
    "Linear",
    "Rays",
    "Response",
    "Sensor",
    "Spread",
    "Srgb",
    "ThinLens",
    "Vignetting",
    "developed",
    "zoomed_pixels",
]
