"""The pose of single markers: both solutions, refined, weighed against each other.

A flat marker that leans towards the viewer looks almost as one that leans away. Both minima are
kept, each with its covariance, and the corners say how probable each is:
P_i ~ exp(-chi2_i / 2). With tilt a, side L px, focal length f px and corner noise s px the wrong
one wins with probability Q(sin(a) L^2 / (2 f s)); better corners make flips rare by themselves.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import marker_corners_m
from tagmetry.pose.ippe import ippe
from tagmetry.pose.refine import Fit, refine, residuals_px
from tagmetry.pose.result import MarkerPose, PoseHypothesis
from tagmetry.pose.stacks import Poses, Sightings
from tagmetry.pose.whitening import whitening

_FARTHEST_PX = 1e9  # no image is so large, and its square is still a number
_SAME_MINIMUM = 0.1  # standard deviations between two refinements that ended in one minimum


def estimate_pose(detection: Detection, camera: Camera, size_m: float) -> MarkerPose:
    """Return the pose of one marker.

    Args:
        detection: The marker's corners in an image of this camera.
        camera: Intrinsics of that image.
        size_m: Side of the marker's black square.

    Returns:
        One or two hypotheses, the likelier first; none where the corners cannot be a marker's (not
        convex, counter-clockwise, outside what the lens shows).

    Raises:
        InputError: The size is not positive.
    """
    return estimate_poses([detection], camera, [size_m])[0]


def estimate_poses(
    detections: Sequence[Detection], camera: Camera, sizes_m: Sequence[float]
) -> tuple[MarkerPose, ...]:
    """Return the poses of several markers, each by itself; see `estimate_pose`."""
    if len(detections) != len(sizes_m):
        raise InputError(f"expected {len(detections)} sizes, got {len(sizes_m)}")
    for size_m in sizes_m:
        check_size(size_m)
    if not detections:
        return ()
    corners = np.stack([detection.corners_px for detection in detections])
    noise = np.stack([detection.corners_cov_px2 for detection in detections])
    hypotheses = solve(corners, noise, np.asarray(sizes_m, dtype=np.float64), camera)
    return tuple(
        MarkerPose(detection.family, detection.id, float(size_m), found)
        for detection, size_m, found in zip(detections, sizes_m, hypotheses, strict=True)
    )


def check_size(size_m: float) -> None:
    """Raise InputError unless the size is a positive number."""
    if not (np.isfinite(size_m) and size_m > 0):
        raise InputError(f"a marker's size must be a positive number of metres, got {size_m}")


def solve(
    corners_px: Array, covariances_px2: Array, sizes_m: Array, camera: Camera
) -> list[tuple[PoseHypothesis, ...]]:
    """Return the hypotheses of n markers, each marker's in falling probability.

    Args:
        corners_px: Shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        sizes_m: Shape (n,).
        camera: Intrinsics.
    """
    within = np.abs(corners_px) < _FARTHEST_PX
    corners_px = np.where(within, corners_px, np.nan)
    seen = Sightings(marker_corners_m(sizes_m), corners_px, whitening(covariances_px2))
    rays = camera.unproject(corners_px)
    possible = _is_marker(corners_px)
    possible &= np.isfinite(rays).all(axis=(1, 2))
    possible &= np.isfinite(seen.whitening).all(axis=(1, 2))
    hypotheses: list[tuple[PoseHypothesis, ...]] = [()] * len(sizes_m)
    if possible.any():
        seen = seen[possible]
        starts = ippe(rays[possible], seen.p_body)
        for n, found in zip(np.flatnonzero(possible), _minima(*starts, seen, camera), strict=True):
            hypotheses[n] = ranked(found)
    return hypotheses


def ranked(found: Sequence[PoseHypothesis | None]) -> tuple[PoseHypothesis, ...]:
    """Return the hypotheses that there are with their probabilities, the likelier first."""
    hypotheses = sorted((h for h in found if h is not None), key=lambda h: h.chi2)
    if not hypotheses:
        return ()
    weights = np.exp([(hypotheses[0].chi2 - h.chi2) / 2 for h in hypotheses])
    shares = weights / weights.sum()
    return tuple(
        replace(h, probability=float(share)) for h, share in zip(hypotheses, shares, strict=True)
    )


def hypotheses_of(fit: Fit, rms_px: Array) -> list[PoseHypothesis | None]:
    """Return one hypothesis per pose; probabilities are still 1.

    Args:
        fit: n pairs of refined poses, the two of a pair in a row.
        rms_px: Their reprojection errors, shape (2n,).

    Returns:
        2n hypotheses; None for what is no pose, and for the second of a pair that is the first.
    """
    covariance = fit.covariances
    usable = np.isfinite(fit.chi2) & np.isfinite(covariance).all(axis=(1, 2))
    is_same = fit[0::2].deviations_to(fit[1::2]) < _SAME_MINIMUM
    usable[1::2] &= ~(usable[0::2] & is_same)
    found: list[PoseHypothesis | None] = [None] * len(usable)
    if usable.any():
        rows = np.flatnonzero(usable)
        for n, T in zip(rows, fit.poses[rows].transforms(), strict=True):
            found[n] = PoseHypothesis(T, covariance[n], float(rms_px[n]), float(fit.chi2[n]), 1.0)
    return found


def _minima(
    start_R: Array, start_t: Array, seen: Sightings, camera: Camera
) -> list[list[PoseHypothesis | None]]:
    """Refine both starts of every marker at once; None for a start that led nowhere new."""
    starts = Poses(start_R.reshape(-1, 3, 3), start_t.reshape(-1, 3))
    twice = seen.repeated(2)
    fit = refine(starts, twice, camera)
    fit = replace(fit, chi2=np.where(_faces_camera(fit.poses), fit.chi2, np.inf))
    both = hypotheses_of(fit, rms_px(residuals_px(fit.poses, twice, camera)))
    return [both[n : n + 2] for n in range(0, len(both), 2)]


def rms_px(residuals_px: Array) -> Array:
    """Return the root mean square length of residuals (..., k, 2), shape (...)."""
    return np.asarray(np.sqrt((residuals_px**2).sum(axis=-1).mean(axis=-1)))


def _is_marker(corners_px: Array) -> BoolArray:
    """Say which quadrilaterals (n, 4, 2) are convex, clockwise and not needle-thin."""
    sides = np.roll(corners_px, -1, axis=1) - corners_px
    lengths = np.linalg.norm(sides, axis=2)
    following = np.roll(sides, -1, axis=1)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        turns = sides[..., 0] * following[..., 1] - sides[..., 1] * following[..., 0]
        sines = turns / (lengths * np.roll(lengths, -1, axis=1))
        return np.asarray((sines > 1e-6).all(axis=1) & np.isfinite(corners_px).all(axis=(1, 2)))


def _faces_camera(poses: Poses) -> BoolArray:
    """Say of which markers the printed face is turned to the camera, shape (n,)."""
    return np.asarray((poses.R_camera_body[:, :, 2] * poses.t_camera_body).sum(axis=1) < 0)
