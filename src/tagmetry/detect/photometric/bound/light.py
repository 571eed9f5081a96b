"""How white pixels are, and how their values change with the light on paper and ink."""

import numpy as np
from scipy.ndimage import gaussian_filter

from tagmetry.detect.photometric.bound.seen import Print, Window
from tagmetry.geometry import Array, apply_homography

FINER = 4  # samples per pixel


def whiteness(sharp: Array, seen: Print) -> Array:
    """Return how white each pixel is, 0 to 1, shape (p,), from `sharp_samples`."""
    rows, columns = (size // FINER for size in sharp.shape)
    blurred = gaussian_filter(sharp, seen.blur_px * FINER, mode="nearest")
    return np.asarray(blurred.reshape(rows, FINER, columns, FINER).mean(axis=(1, 3)).ravel())


def sharp_samples(window: Window, seen: Print) -> Array:
    """Return how white samples within pixels are without a blur but motion's, FINER to a pixel."""
    x, y = np.meshgrid(*((np.arange(FINER * n) + 0.5) / FINER - 0.5 for n in window.size_px))
    samples: Array = np.stack([x, y], axis=-1).reshape(-1, 2)
    moments = [_sharp(window, seen, samples - shift) for shift in seen.shifts_px]
    return np.asarray(np.mean(moments, axis=0).reshape(x.shape))


def _sharp(window: Window, seen: Print, places_px: Array) -> Array:
    """Return where there is white at places (n, 2) without any blur, 0 or 1."""
    places = apply_homography(np.asarray(np.linalg.inv(window.H)), places_px)
    cell = np.floor(places * seen.side_cells).astype(int) + seen.margin_cells
    on = np.asarray(((cell >= 0) & (cell < len(seen.picture))).all(axis=1))
    column, row = np.where(on[:, None], cell, 0).T
    return np.where(on, seen.picture[row, column], 1.0)


def values(white: Array, seen: Print) -> Array:
    """Return the grey values of pixels."""
    low, high = _lights(seen)
    return np.asarray((low + (high - low) * white) ** (1 / seen.exponent))


def variances(white: Array, seen: Print, noise: float) -> Array:
    """Return the variances of grey values: of the noise, and of light itself, shape (p,)."""
    return np.asarray(noise**2 + seen.grey_per_electron * values(white, seen))


def by_whiteness(white: Array, seen: Print) -> Array:
    """Return the grey values' derivatives by the whiteness, shape (p,)."""
    low, high = _lights(seen)
    return _by_light(white, seen) * (high - low)


def by_levels(white: Array, seen: Print) -> Array:
    """Return the grey values' derivatives by those of black and white, shape (p, 2)."""
    low, high = _lights(seen)
    by_light, power = _by_light(white, seen), seen.exponent
    by_black = by_light * (1 - white) * power * low / seen.black
    return np.stack([by_black, by_light * white * power * high / seen.white], axis=1)


def by_exponent(white: Array, seen: Print) -> Array:
    """Return the grey values' derivatives by the exponent, black and white held, shape (p,)."""
    low, high = _lights(seen)
    value, power = values(white, seen), seen.exponent
    by_low = low * np.log(seen.black) * (1 - white) + high * np.log(seen.white) * white
    return np.asarray(_by_light(white, seen) * by_low - value * np.log(value) / power)


def by_slopes(white: Array, seen: Print, window: Window) -> Array:
    """Return the derivatives by light that grows to the right and down, shape (p, 4).

    On black and white alike, and on white alone.
    """
    columns, rows = (np.linspace(-1, 1, size) for size in window.size_px)
    x, y = (one.ravel() for one in np.meshgrid(columns, rows))
    light = _by_light(white, seen) * _lights(seen)[1]
    return np.stack([light * x, light * y, light * white * x, light * white * y], axis=1)


def _lights(seen: Print) -> tuple[float, float]:
    return seen.black**seen.exponent, seen.white**seen.exponent


def _by_light(white: Array, seen: Print) -> Array:
    value = values(white, seen)
    return np.asarray(value ** (1 - seen.exponent) / seen.exponent)
