"""How well will a marker be measured at a setting, before it is tried?

In pixels that the sensor really has ("resolved": beyond `native_percent` zoom only enlarges), with
L the marker's side, c a cell, b the blur's standard deviation, a corner is known to about

    s^2 = NOISE^2 b / L + (SHARP min(1, 10 / c) exp(-(b / 0.25)^2))^2
          + (LEFT max(1, 8 / c))^2 + (FLAT L)^2 + (b^2 where it is too wide for a fit)

and the depth to the share s / (sqrt(2) L). The second term is what pixels miss of an edge that is
sharper than they are: where exactly it lies between two of them. A lens out of focus by half a
pixel spreads it over several, and takes it away, for hardly more noise: the sharpest image is not
the best one. The constants were measured on the twin, against its truth; FLAT is what is left of
markers that fill the image, whose parts are not all as sharp.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.lens.readable import MarkerKind
from tagmetry.lens.setting import LensSetting
from tagmetry.lens.zoom_lens import ZoomLens

_NOISE_PX = 0.02
_SHARP_PX = 0.022
_LEFT_PX = 0.003
_SMALL_CELL_PX = 8.0
_FLAT = 7e-5
_SPREADS_PX = 0.25
SOFT_PX = 0.5  # blur by defocus that is best, resolved pixels
_FINE_CELL_PX = 10.0
_SHARPEST_PX = 0.6  # what is left of the blur in focus, a pixel's own square in it
DESCRIBED_PX = 3.6  # blur up to which a detector's picture of edges is right


@dataclass(frozen=True)
class Prospect:
    """What a setting promises.

    Attributes:
        depth_share: Standard deviation of the depth, as a share of it.
        turn_rad: Of the turn about an axis in the image plane, for a marker tilted by `tilt_rad`.
    """

    depth_share: float
    turn_rad: float


def prospect(
    lens: ZoomLens, marker: MarkerKind, depth_m: float, setting: LensSetting, tilt_rad: float = 0.0
) -> Prospect:
    """Return what a setting promises for a marker at a depth."""
    resolved = min(setting.magnification, lens.native_percent / 100)
    side_px = lens.focal_px(resolved) * marker.size_m / depth_m
    blur_px = lens.blur_of_depth_px(setting, depth_m) / 4
    s_px = corner_error_px(side_px, marker.side_cells, blur_px, resolved / setting.magnification)
    share = s_px / (np.sqrt(2) * side_px)
    foreshortening = max(abs(np.sin(tilt_rad)), float(np.sqrt(share)))
    return Prospect(float(share), float(share / foreshortening))


def corner_error_px(
    side_px: float, side_cells: int, blur_px: float, resolved_per_px: float = 1.0
) -> float:
    """Return a corner's standard deviation along an axis, resolved pixels.

    Args:
        side_px: The marker's side, resolved pixels.
        side_cells: Cells along it.
        blur_px: Blur by defocus, in the image's own pixels.
        resolved_per_px: Resolved pixels in one of the image's.
    """
    blur = float(np.hypot(_SHARPEST_PX, blur_px * resolved_per_px))
    noise2 = _NOISE_PX**2 * blur / side_px
    return float(
        np.sqrt(noise2 + unmodelled_px(side_px, side_cells, blur_px, resolved_per_px) ** 2)
    )


def unmodelled_px(
    side_px: float, side_cells: int, blur_px: float, resolved_per_px: float = 1.0
) -> float:
    """Return what of it no image's noise tells; arguments as above."""
    cell_px = side_px / side_cells
    beyond = blur_px if blur_px > DESCRIBED_PX else 0.0
    sharp_px = _SHARP_PX * min(1.0, _FINE_CELL_PX / cell_px)
    sharp_px *= float(np.exp(-((blur_px * resolved_per_px / _SPREADS_PX) ** 2)))
    left_px = _LEFT_PX * max(1.0, _SMALL_CELL_PX / cell_px)
    return float(np.linalg.norm([sharp_px, left_px, _FLAT * side_px, beyond * resolved_per_px]))
