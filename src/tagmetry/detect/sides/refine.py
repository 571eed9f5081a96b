"""Where exactly are a marker's corners? A blurred step is fitted to the raw pixels along each side.

sides (where they are expected) -> window (the pixels around them) -> step (where each edge is)
-> straighten (what to believe of bows) -> corners where neighbouring sides meet.

Through a lens with distortion a side is a curve. Where the camera is known, distances are measured
from that curve.

A camera's gamma curve moves every such edge outward or inward by up to 0.3 px, which a single side
cannot tell and the covariance does not contain.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.rows import Rows
from tagmetry.detect.sides.sides import Sides
from tagmetry.detect.sides.step import fit_steps
from tagmetry.detect.sides.straighten import model_error, straightened
from tagmetry.detect.sides.window import gather
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_LOST_PX = 2.5  # a side that moved farther was not the one meant
_UNREFINED_PX2 = np.diag([4.0, 4.0])  # of a side's offset and turn, where the fit failed


@dataclass(frozen=True, eq=False)
class Corners(Rows):
    """Refined corners of n markers.

    Attributes:
        corners_px: Shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        refined: Whether all four sides were found, shape (n,); a side that was not found stays
            where it was given, with a covariance to match.
    """

    corners_px: Array
    covariances_px2: Array
    refined: BoolArray


def refine(
    grey: GreyPixels, corners_px: Array, cell_counts: Array, camera: Camera | None = None
) -> Corners:
    """Refine corners to a few hundredths of a pixel.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: First guesses, good to about a pixel, clockwise, shape (n, 4, 2).
        cell_counts: Cells along a side of each marker, shape (n,).
        camera: Intrinsics, so that sides are followed along their curves.
    """
    sides = Sides.of(corners_px, cell_counts, camera)
    fit, covariance, sound = fit_steps(gather(grey, sides))
    sound &= np.abs(fit[:, :2]).sum(axis=1) < _LOST_PX
    tells = sound & sides.may_bow
    shift, covariance = straightened(fit[:, :3], covariance, sides.half_px, tells)
    covariance = covariance + model_error(sides.cell_px, fit[:, 7])
    shift = np.where(sound[:, None], shift, 0.0)
    covariance = np.where(sound[:, None, None], covariance, _UNREFINED_PX2)
    moved, covariances = _meet(sides, shift, covariance)
    usable = np.asarray(np.isfinite(moved).all(axis=(1, 2)))
    usable &= np.isfinite(covariances).all(axis=(1, 2))
    return Corners(
        np.where(usable[:, None, None], moved, corners_px),
        np.where(usable[:, None, None], covariances, 2 * _UNREFINED_PX2[0, 0] * np.eye(8)),
        sound.reshape(-1, 4).all(axis=1) & usable,
    )


def _meet(sides: Sides, shift: Array, covariance: Array) -> tuple[Array, Array]:
    """Return the corners (n, 4, 2) where neighbouring sides meet, and their covariances (n, 8, 8).

    Corner i lies on side i (at u = -1) and on side i - 1 (at u = +1): it moves by the x that solves
    outward . x = offset + turn * u for both.
    """
    outward = sides.outward.reshape(-1, 4, 2)
    before = np.roll(outward, 1, axis=1)
    N = np.stack([outward, before], axis=2)  # (n, 4, 2 lines, 2)
    N_inverse = np.linalg.inv(np.where(np.abs(np.linalg.det(N))[..., None, None] > 1e-3, N, np.nan))
    offset, turn = shift.reshape(-1, 4, 2).transpose(2, 0, 1)
    at_start, at_end = offset - turn, np.roll(offset + turn, 1, axis=1)
    moved = N_inverse @ np.stack([at_start, at_end], axis=2)[..., None]
    first = (sides.middle - sides.half_px[:, None] * sides.along).reshape(-1, 4, 2)
    return first + moved[..., 0], _corner_covariances(N_inverse, covariance)


def _corner_covariances(N_inverse: Array, covariance: Array) -> Array:
    """Carry the sides' (offset, turn) to the corners: J blockdiag(covariance) J^T."""
    n = len(N_inverse)
    per_side = covariance.reshape(n, 4, 2, 2)
    J = np.zeros((n, 8, 8))
    for corner in range(4):
        for line, side, u in ((0, corner, -1.0), (1, (corner - 1) % 4, 1.0)):
            column = N_inverse[:, corner, :, line]
            J[:, 2 * corner : 2 * corner + 2, 2 * side] += column
            J[:, 2 * corner : 2 * corner + 2, 2 * side + 1] += u * column
    blocks = np.zeros((n, 8, 8))
    for side in range(4):
        blocks[:, 2 * side : 2 * side + 2, 2 * side : 2 * side + 2] = per_side[:, side]
    return np.asarray(J @ blocks @ np.swapaxes(J, 1, 2))
