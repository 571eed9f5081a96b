"""Where exactly are the corners of a chessboard? Each is fitted as a blurred crossing of two edges.

Around a corner c the picture is

    I(p) = (a + b (erf(d1 / (sqrt(2) s)) erf(d2 / (sqrt(2) s)) + q)) (1 + g . p),
    d = n . (p - c) - k / 2 ((t . (p - c))^2 + s^2)                 across an edge

two edges with unit normals n, directions t and curvatures k, a mean grey a, half the contrast b, a
blur s (in pixels, the pixel's own area included) and light that grows by g from pixel to pixel; q
is what edges that are not square to each other add where they cross (`crossing`). The curvatures
are given (`bends`); all other nine unknowns are fitted to the raw pixels by Levenberg-Marquardt,
and the covariance of c follows from the residuals. Taken for straight over +-L, an edge would be
found k L^2 / 6 to the inside of its curve: 0.01 px behind usual lenses, in all views alike.
Whatever is the same on both sides of c, such as spread ink or a camera's gamma curve, does not
move c.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.targets.crossing import (
    BLUR,
    HALF_CONTRAST,
    UNKNOWNS,
    UNKNOWNS_IN_EVEN_LIGHT,
    fit_crossings,
)
from tagmetry.calibrate.view import mean_sd_px, round_covariances
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray

_FLOOR_PX = 0.0002  # what the model leaves out, on noiseless rendered boards
_SHARP_SD_PX = 0.02  # with no blur at all, as a pixel's square is no Gaussian
_PIXEL_PX, _SOFT_PX = 0.29, 0.42  # blur of a pixel alone, and from which on it looks Gaussian
_WORST_CONDITION = 1e14
_CHANCE = 3.0  # standard deviations of the logarithm of a variance
_QUANTUM = 1 / np.sqrt(12)  # standard deviation of rounding to whole grey values


@dataclass(frozen=True, eq=False)
class Saddles:
    """The fitted corners.

    Attributes:
        centres_px: Shape (n, 2).
        covariances_px2: Of the centres, shape (n, 2, 2).
        blur_px: Standard deviation of the edges' blur, shape (n,).
        contrast: White minus black, grey values, shape (n,).
        noise: Standard deviation of what the model leaves, grey values, shape (n,).
        is_saddle: Whether the fit is one that could be meant, shape (n,); the rest is not to be
            used.
    """

    centres_px: Array
    covariances_px2: Array
    blur_px: Array
    contrast: Array
    noise: Array
    is_saddle: BoolArray

    @property
    def sd_px(self) -> Array:
        """Standard deviation of the centres along an axis, shape (n,)."""
        return mean_sd_px(self.covariances_px2)


def fit_saddles(
    grey: GreyPixels,
    guesses_px: Array,
    along_px: Array,
    down_px: Array,
    half: float = 1 / 3,
    arm: float = 1.0,
    bends: Array | None = None,
) -> Saddles:
    """Fit corners between squares.

    Args:
        grey: 8-bit image, shape (height, width), or one for each corner, (n, height, width).
        guesses_px: Where the corners are about, shape (n, 2).
        along_px: From each to the next corner in its row, shape (n, 2).
        down_px: From each to the next corner in its column, shape (n, 2).
        half: Half the window's side, as a share of these steps.
        arm: Only pixels this close to an edge, as a share of the steps, are looked at; the rest may
            hold a marker.
        bends: Curvature of the edges along the rows and down the columns, shape (n, 2), 1 / px
            (`line_bends`). Without them edges are taken for straight and the light for even, which
            is enough to begin with.
    """
    free = UNKNOWNS if bends is not None else UNKNOWNS_IN_EVEN_LIGHT
    bends = np.zeros((len(guesses_px), 2)) if bends is None else np.ascontiguousarray(bends)
    steps_px = np.ascontiguousarray(np.stack([along_px, down_px], axis=-1), dtype=np.float64)
    guesses_px = np.ascontiguousarray(guesses_px, dtype=np.float64)
    greys = np.ascontiguousarray(grey if grey.ndim == 3 else grey[None])
    fit = _Fit(*fit_crossings(greys, guesses_px, steps_px, bends, half, arm, free))
    return _judged(fit, guesses_px, steps_px)


@dataclass(frozen=True, eq=False)
class _Fit:
    """What `fit_crossings` gives."""

    unknowns: Array
    curvatures: Array
    squares: Array
    counts: IntArray


def _judged(fit: _Fit, guesses_px: Array, steps_px: Array) -> Saddles:
    """Say how certain each corner is, and which are none."""
    free = fit.curvatures.shape[1]
    freedom = np.maximum(fit.counts - free, 1.0)
    noise = np.sqrt((fit.squares + _QUANTUM**2) / freedom)
    by_unit_noise, solvable = _place_covariances(fit.curvatures)
    blur_px, contrast = np.exp(fit.unknowns[:, BLUR]), 2 * np.abs(fit.unknowns[:, HALF_CONTRAST])
    shortest_px = np.linalg.norm(steps_px, axis=1).min(axis=1)
    is_saddle = (
        solvable
        & (fit.counts > 2 * free)
        & (contrast > np.maximum(6.0, 4 * noise))
        & (blur_px < 0.4 * shortest_px)
    )
    sharp = np.clip((_SOFT_PX - blur_px) / (_SOFT_PX - _PIXEL_PX), 0.0, 1.0)
    floor_px2 = round_covariances(_FLOOR_PX + _SHARP_SD_PX * sharp)
    variances = _common_where_alike(noise**2, freedom)
    covariances_px2 = by_unit_noise * variances[:, None, None] + floor_px2
    centres_px = guesses_px + fit.unknowns[:, :2]
    return Saddles(centres_px, covariances_px2, blur_px, contrast, noise, np.asarray(is_saddle))


def _common_where_alike(variances: Array, freedom: Array) -> Array:
    """Return the noise's variances, the common one where a corner's is within chance of it.

    Some tens of pixels tell a variance to a quarter only. Corners weighed by such guesses are worse
    than corners weighed alike, and worse than they say.
    """
    common = np.median(variances)
    far = np.abs(np.log(variances / common)) > _CHANCE * np.sqrt(2 / freedom)
    return np.where(far, variances, common)


def _place_covariances(curvatures: Array) -> tuple[Array, BoolArray]:
    """Return corners' covariances (n, 2, 2) by unit noise, and whether there is one."""
    solvable = np.linalg.cond(curvatures) < _WORST_CONDITION
    safe = np.where(solvable[:, None, None], curvatures, np.eye(curvatures.shape[1]))
    inverse = np.linalg.inv(safe)[:, :2, :2]
    return (inverse + np.swapaxes(inverse, 1, 2)) / 2, np.asarray(solvable)
