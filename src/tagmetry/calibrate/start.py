"""Where to begin: several guesses of camera and poses, good enough to refine.

OpenCV begins with one guess, a pinhole with the focal length of Zhang's equations, and stays in
whatever minimum that leads to. Here the lens comes first. With the division model (A. Fitzgibbon,
2001) pixels straighten as

    u_straight = u / (1 + bend r^2)          r from the image's centre, in half diagonals

and a flat board maps to straightened pixels by a homography whatever the focal length is. So the
bend under which homographies fit best is found by itself, and Zhang's equations then hold for the
straightened pixels, at 60 as at 160 degrees of view.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.homographies import fit_homographies
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.zhang import (
    closed_form,
    focal_lengths,
    least_squares_focal,
    poses_from_homographies,
)
from tagmetry.geometry import Array, apply_homography

_BENDS = np.concatenate([-np.geomspace(0.97, 0.01, 24), [0.0], np.geomspace(0.02, 0.5, 6)])
_FIELDS_RAD = np.radians([35.0, 55.0, 80.0, 110.0])  # of view, along the diagonal


@dataclass(frozen=True, eq=False)
class BoardPlane:
    """The plane the board's points lie in.

    Attributes:
        origin: Shape (3,), metres, board frame.
        axes: x, y and normal of the plane as columns, shape (3, 3), a rotation.
    """

    origin: Array
    axes: Array

    @classmethod
    def through(cls, p_board: Array) -> "BoardPlane":
        """Return the plane of least squares, its normal on the side the face looks to (+z)."""
        origin = p_board.mean(axis=0)
        _, _, rows = np.linalg.svd(p_board - origin)
        normal = rows[2] * (-1.0 if rows[2, 2] < 0 else 1.0)
        return cls(origin, np.stack([rows[0], np.cross(normal, rows[0]), normal], axis=1))

    def flat(self, p_board: Array) -> Array:
        """Return coordinates in the plane, shape (k, 2), metres."""
        return np.asarray((p_board - self.origin) @ self.axes[:, :2])


def starts(
    seen: Sightings, kind: Literal["brown", "fisheye"], coefficients: int
) -> tuple[list[Bundle], float]:
    """Return guesses of a lens with so many coefficients, the most likely first.

    Args:
        seen: What the views show; every view at least four points, not on a line.
        kind: Of the lens.
        coefficients: How many the lens has.

    Returns:
        The guesses, and the median error in px that homographies leave: no guess is right whose
        error is much larger once it is refined.
    """
    plane = BoardPlane.through(seen.p_board)
    half = 0.5 * np.hypot(*seen.size_px)
    centre = (np.array(seen.size_px) - 1) / 2
    pixels = (seen.corners_px - centre) / half
    bend, error, H = _best_bend(plane.flat(seen.p_board), pixels, seen)
    farthest = float(np.linalg.norm(pixels[seen.used], axis=-1).max())
    bundles = []
    for K in _matrices(H):
        lens = _lens(kind, coefficients, K[0, 0], bend, farthest)
        focal, center = np.diag(K)[:2] * half, K[:2, 2] * half + centre
        intrinsics = np.concatenate([focal, center, lens])
        bundles.append(Bundle(kind, intrinsics, *_poses(K, H, plane), seen.p_board))
    return bundles, error * half


def _poses(K: Array, H: Array, plane: BoardPlane) -> tuple[Array, Array]:
    """Return the poses of the board from those of its plane."""
    R, t = poses_from_homographies(K, H)
    R_camera_board = R @ plane.axes.T
    return R_camera_board, t - R_camera_board @ plane.origin


def _best_bend(xy: Array, pixels: Array, seen: Sightings) -> tuple[float, float, Array]:
    """Return the bend with the least error of homographies, that error, and these."""
    farthest2 = float((pixels[seen.used] ** 2).sum(axis=1).max())
    fits = [_fit(xy, pixels, seen.weights, bend / farthest2) for bend in _BENDS]
    best = int(np.argmin([error for error, _ in fits]))
    return float(_BENDS[best] / farthest2), *fits[best]


def _fit(xy: Array, pixels: Array, weights: Array, bend: float) -> tuple[float, Array]:
    """Return the error in the picture, and the homographies, of straightened pixels."""
    H = fit_homographies(xy, straightened(pixels, bend), weights)
    error = bent(apply_homography(H, xy), bend) - pixels
    squared = (error**2).sum(axis=-1)
    each = (weights * squared).sum(axis=1) / weights.sum(axis=1)
    return float(np.nan_to_num(np.sqrt(np.median(each)), nan=np.inf)), H


def straightened(pixels: Array, bend: float) -> Array:
    """Return u / (1 + bend r^2)."""
    r2 = (pixels**2).sum(axis=-1, keepdims=True)
    return np.asarray(pixels / (1 + bend * r2))


def bent(straight: Array, bend: float) -> Array:
    """Return the inverse of `straightened`: r = (1 - sqrt(1 - 4 bend s^2)) / (2 bend s)."""
    s2 = (straight**2).sum(axis=-1, keepdims=True)
    root = np.sqrt(np.maximum(1 - 4 * bend * s2, 0.0))
    return np.asarray(2 * straight / (1 + root))


def _matrices(H: Array) -> list[Array]:
    """Return guesses of K for straightened pixels in half diagonals around the image's centre."""
    told = focal_lengths(H)
    focal = [least_squares_focal(H), float(np.median(told)) if told.size else np.nan]
    focal += [float(f) for f in 1 / np.tan(_FIELDS_RAD / 2)]
    matrices = [np.diag([f, f, 1.0]) for f in focal if np.isfinite(f) and 0.05 < f < 50]
    zhang = closed_form(H)
    if zhang is not None and _is_likely(zhang):
        matrices.insert(0, zhang)
    return matrices


def _is_likely(K: Array) -> bool:
    (fx, fy), centre = np.diag(K)[:2], K[:2, 2]
    return bool(np.abs(centre).max() < 0.5 and 0.5 < fx / fy < 2 and 0.05 < fx < 50)


def _lens(kind: str, coefficients: int, focal: float, bend: float, farthest: float) -> Array:
    """Return coefficients that bend like the division model, up to the farthest corner.

    Least squares for what multiplies x^3, x^5 and x^7 in a Brown lens, x the tangent of the angle
    from the axis, or a fisheye's t^3 and t^5, t the angle itself.
    """
    lens = np.zeros(coefficients)
    if coefficients == 0 or bend == 0:
        return lens
    radius = np.linspace(0.02, 1.0, 40) * farthest
    straight = radius / (1 + bend * radius**2) / focal
    x = np.arctan(straight) if kind == "fisheye" else straight
    places = [0, 1] if kind == "fisheye" or coefficients == 4 else [0, 1, 4]
    powers = x[:, None] ** (3 + 2 * np.arange(len(places)))
    lens[places] = np.linalg.lstsq(powers, radius / focal - x, rcond=None)[0]
    return lens
