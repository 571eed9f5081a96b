"""The best focus of a sweep, and the aperture that its blur tells.

A point at depth z is spread over a disc of diameter A f |1/z - 1/d| pixels when the lens is
focused at d (A: aperture in metres, f: focal length in pixels). A disc of diameter c has the
variance (c / 4)^2 along an axis, and variances of blurs add:

    blur^2 = least^2 + (A f / 4)^2 (1/z - 1/d)^2

Around the best focus F* the distance 1/d goes on in proportion to F, so blur^2 is a parabola in F;
where there are images enough its third power is fitted too, as 1/d curves.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.lens.focus_law import FocusLaw

_LEAST_IMAGES = 4
_LEAST_FOR_CUBIC = 6
_NEAR_PEAK = 3.0  # of the least blur: farther off the parabola is bent


@dataclass(frozen=True)
class FocusPeak:
    """Where a sweep is sharpest.

    Attributes:
        focus: The focus value F*.
        sd: Its standard deviation.
        blur_px: Blur there.
    """

    focus: float
    sd: float
    blur_px: float


def focus_peak(focus_values: Sequence[float], blurs_px: Sequence[float]) -> FocusPeak:
    """Return the sharpest focus of a sweep over a target that stands still.

    Args:
        focus_values: Where the images were taken, shape (n,).
        blurs_px: Standard deviation of the blur in each; NaN where there was none to measure.

    Raises:
        InputError: Too few images tell, or the sharpest lies beyond the sweep.
    """
    focus, blur2 = _near_peak(focus_values, blurs_px)
    middle = float(focus[blur2.argmin()])
    x = focus - middle
    degree = 3 if len(x) >= _LEAST_FOR_CUBIC else 2
    J = np.vander(x, degree + 1, increasing=True) / blur2[:, None]  # errors grow with blur^2
    numbers: Array = np.asarray(np.linalg.lstsq(J, np.ones_like(x), rcond=None)[0])
    residual = 1 - J @ numbers
    noise2 = float(residual @ residual) / max(len(x) - degree - 1, 1)
    covariance = noise2 * np.linalg.pinv(J.T @ J)
    peak = _lowest(numbers, float(x.min()), float(x.max()))
    if not np.isfinite(peak):
        raise InputError(
            f"the sharpest focus is not within the sweep from {focus.min():g} to {focus.max():g}; "
            "sweep farther"
        )
    slopes = np.arange(degree + 1) * peak ** np.maximum(np.arange(degree + 1) - 1, 0)
    by_numbers = -slopes / np.polynomial.Polynomial(numbers).deriv(2)(peak)
    sd = float(np.sqrt(by_numbers @ covariance @ by_numbers))
    least2 = float(np.polynomial.Polynomial(numbers)(peak))
    return FocusPeak(middle + peak, sd, float(np.sqrt(max(least2, 0.0))))


def _lowest(numbers: Array, low: float, high: float) -> float:
    """Return where a polynomial has a minimum within a range; NaN where it has none."""
    curve = np.polynomial.Polynomial(numbers)
    roots = curve.deriv().roots()
    real = roots[np.abs(roots.imag) < 1e-9].real
    lows = [float(x) for x in real if low <= x <= high and curve.deriv(2)(x) > 0]
    return lows[0] if lows else float("nan")


def aperture_m(
    focus_values: Sequence[float],
    blurs_px: Sequence[float],
    law: FocusLaw,
    focus: float,
    focal_px: float,
) -> float:
    """Return the aperture's diameter that a sweep's blur tells.

    Args:
        focus_values: Of the images, shape (n,).
        blurs_px: Standard deviations of the blur; NaN where there was none to measure.
        law: Which depth is sharp at which value.
        focus: The sharpest focus value.
        focal_px: Focal length of the images.
    """
    known = np.isfinite(blurs_px)
    distance_m = np.array([law.depth_m(float(value)) for value in focus_values])[known]
    off = (1 / distance_m - 1 / law.depth_m(focus)) ** 2
    blur2 = np.asarray(blurs_px, dtype=np.float64)[known] ** 2
    if len(blur2) < 2 or not np.ptp(off) > 0:
        raise InputError("an aperture needs images at two focus values or more")
    slope = float(np.polyfit(off, blur2, 1)[0])
    return 4 * float(np.sqrt(max(slope, 0.0))) / focal_px


def _near_peak(focus_values: Sequence[float], blurs_px: Sequence[float]) -> tuple[Array, Array]:
    """Return focus values and squared blurs of the images that are not far from the sharpest."""
    focus = np.asarray(focus_values, dtype=np.float64)
    blur = np.asarray(blurs_px, dtype=np.float64)
    if focus.shape != blur.shape or focus.ndim != 1:
        raise InputError(f"expected a blur for each focus value, got {blur.shape}, {focus.shape}")
    with np.errstate(invalid="ignore"):
        near = np.isfinite(focus) & (blur > 0)
        near &= blur <= _NEAR_PEAK * np.min(blur[near], initial=np.inf)
    if len(np.unique(focus[near])) < _LEAST_IMAGES:
        raise InputError(
            f"the sharpest focus needs {_LEAST_IMAGES} images around it that show the target, got "
            f"{len(np.unique(focus[near]))}; take smaller steps"
        )
    return focus[near], blur[near] ** 2
