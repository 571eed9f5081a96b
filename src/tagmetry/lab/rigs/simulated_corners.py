"""What the detector would say of markers on a floor, without pictures: true corners and noise.

The noise of a marker's corners is drawn from the covariance that the detector's have (`detect`'s
bound). That is so quick that small differences show, and two layouts can be compared that share
markers: the shared ones then have the same noise.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from tagmetry.detect import Detection
from tagmetry.detect.photometric.bound import Print, detector_covariance_px2
from tagmetry.geometry import Array, RigidTransform
from tagmetry.lab.rigs.marker_floor import CAMERA
from tagmetry.localize import MapMarker
from tagmetry.markers import family

BLUR_PX, NOISE_GREY = 0.5, 1.0  # as the simulator's pictures of seed 002 have
_BLACK_GREY, _WHITE_GREY = 15.0, 217.0
_ALL_NOISE_GREY = np.hypot(NOISE_GREY, np.sqrt(1 / 12))


def corner_covariances_px2(
    markers: Sequence[MapMarker], T_world_camera: RigidTransform
) -> dict[int, Array]:
    """Return the covariances that corners of markers have, (8, 8), of those that are seen."""
    corners_px = {one.id: _corners_px(one, T_world_camera) for one in markers}
    return {
        one.id: _covariance_px2(one, corners_px[one.id])
        for one in markers
        if _is_seen(corners_px[one.id])
    }


def seen_corners(
    markers: Sequence[MapMarker],
    T_world_camera: RigidTransform,
    covariances_px2: Mapping[int, Array],
    rng: np.random.Generator,
) -> Iterator[Detection]:
    """Give the markers that the camera sees whole and from the front, with noise.

    Every marker takes as many random numbers, seen or not.

    Args:
        markers: At their places in the world.
        T_world_camera: Where the camera is.
        covariances_px2: From about there, by the markers' ids; the others are not seen.
        rng: Where the noise comes from.
    """
    for one in markers:
        normal = rng.standard_normal(8)
        corners_px = _corners_px(one, T_world_camera)
        if one.id in covariances_px2 and _is_seen(corners_px):
            covariance_px2 = covariances_px2[one.id]
            noise_px = (np.linalg.cholesky(covariance_px2) @ normal).reshape(4, 2)
            yield Detection(one.family, one.id, corners_px + noise_px, covariance_px2, 0, 1.0)


def _corners_px(marker: MapMarker, T_world_camera: RigidTransform) -> Array:
    return CAMERA.project(np.asarray(T_world_camera.inv().apply(marker.p_world)))


def _is_seen(corners_px: Array) -> bool:
    """Say whether a marker is seen whole, and from its face."""
    x, y = corners_px.T
    is_clockwise = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() > 0
    return bool(CAMERA.contains(corners_px).all() and is_clockwise)


def _covariance_px2(marker: MapMarker, corners_px: Array) -> Array:
    kind = family(marker.family)
    printed = Print(
        kind.picture(marker.id), kind.layout.margin_cells, _BLACK_GREY, _WHITE_GREY, BLUR_PX
    )
    return detector_covariance_px2(corners_px, printed, float(_ALL_NOISE_GREY))
