"""What interpolating between calibrations costs, as the calibrations themselves show it.

The error of interpolating a smooth law between two neighbours is bounded by half its second
derivative times (s - low) (high - s), here the leverage. A bend is that error over the leverage.
"""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from tagmetry.camera.bank.parameters import displacement_px, mean_variance_px2
from tagmetry.camera.model import Camera
from tagmetry.geometry.arrays import Array

_ANY_MONOTONE = 4 / np.sqrt(12)  # over the leverage: half way, evenly between the two ends


@dataclass(frozen=True, eq=False)
class Bend:
    """An error of interpolating over its leverage.

    Attributes:
        error_px: Displacements over the pixel grid, shape (n, 2).
        explained_px2: What the calibrations' own noise makes of the mean square.
    """

    error_px: Array
    explained_px2: float


def bend_at(camera: Camera, predicted: Camera, leverage: float) -> Bend | None:
    """Return what leaving a calibration out shows, or None where a covariance is missing.

    Args:
        camera: The one that was left out.
        predicted: What the others say.
        leverage: Of its setting between its two neighbours.
    """
    return _bend(predicted, camera, 1 / leverage)


def bend_between_two(first: Camera, last: Camera, gap: float) -> Bend | None:
    """Return the doubt of a bank of two, or None where a covariance is missing.

    There is none to leave out. A law that only rises, or only falls, passes anywhere between the
    two: half way its standard deviation is that of an even spread, so that 1.96 of them hold every
    such law there.

    Args:
        first: One calibration.
        last: The other.
        gap: Between their settings.
    """
    return _bend(last, first, _ANY_MONOTONE / gap**2)


def unexplained_share(bends: Collection[Bend]) -> float:
    """Return the share of the bends' mean square that the calibrations' noise does not explain."""
    seen = sum(float(np.nansum(bend.error_px**2)) / len(bend.error_px) for bend in bends)
    explained = sum(bend.explained_px2 for bend in bends)
    return max(0.0, 1.0 - explained / max(seen, 1e-300))


def _bend(found: Camera, expected: Camera, scale: float) -> Bend | None:
    if found.covariance is None or expected.covariance is None:
        return None
    explained_px2 = mean_variance_px2(found) + mean_variance_px2(expected)
    return Bend(scale * displacement_px(found, expected), scale**2 * explained_px2)
