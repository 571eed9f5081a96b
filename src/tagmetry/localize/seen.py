"""The markers of an image that the map knows, and why the others are passed over."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.detect import Detection
from tagmetry.geometry import Array
from tagmetry.localize.marker_map import MapMarker, MarkerMap
from tagmetry.localize.result import Rejection
from tagmetry.markers.bodies import MarkerKey

_FARTHEST_PX = 1e6


@dataclass(frozen=True, eq=False)
class SeenMarker:
    """A marker of the map and where an image shows it."""

    marker: MapMarker
    detection: Detection


@dataclass(frozen=True, eq=False)
class KnownMarkers:
    """What an image shows of the map.

    Attributes:
        seen: The markers, in the order of the detections.
        passed_over: The others, with the reason.
    """

    seen: tuple[SeenMarker, ...]
    passed_over: tuple[Rejection, ...]

    @property
    def why_none(self) -> str:
        """Why there is nothing to go by, in words."""
        if not self.passed_over:
            return "the image shows no marker"
        listed = [f"{one.key.family} id {one.key.id}: {one.why}" for one in self.passed_over[:3]]
        more = "; …" if len(self.passed_over) > 3 else ""
        return f"the image shows no usable marker of the map ({'; '.join(listed)}{more})"


def known_markers(detections: Sequence[Detection], marker_map: MarkerMap) -> KnownMarkers:
    """Sort detections into those that the map knows and those that are passed over."""
    times = Counter((detection.family, detection.id) for detection in detections)
    usable = _are_usable(detections)
    seen: list[SeenMarker] = []
    passed_over: dict[MarkerKey, str] = {}
    for detection, is_usable in zip(detections, usable, strict=True):
        key = MarkerKey(detection.family, detection.id)
        marker = marker_map.by_key.get(key)
        if marker is None:
            passed_over[key] = "it is not in the map"
        elif times[key] > 1:
            passed_over[key] = f"it was seen {times[key]} times in one image"
        elif not is_usable:
            passed_over[key] = "its corners or their covariance are no usable numbers"
        else:
            seen.append(SeenMarker(marker, detection))
    return KnownMarkers(tuple(seen), tuple(Rejection(*item) for item in passed_over.items()))


def _are_usable(detections: Sequence[Detection]) -> list[bool]:
    """Say of each marker whether its numbers are; all at once, since they nearly always are."""
    try:
        if _is_usable(detections):
            return [True] * len(detections)
    except ValueError:  # some are of another shape
        pass
    return [_is_usable([one]) for one in detections]


def _is_usable(detections: Sequence[Detection]) -> bool:
    corners = np.array([one.corners_px for one in detections], dtype=np.float64)
    covariances = np.array([one.corners_cov_px2 for one in detections], dtype=np.float64)
    if corners.shape[1:] != (4, 2) or covariances.shape[1:] != (8, 8):
        return False
    return bool((np.abs(corners) < _FARTHEST_PX).all()) and _are_positive(covariances)


def _are_positive(covariances: Array) -> bool:
    if not np.isfinite(covariances).all():
        return False
    try:
        np.linalg.cholesky(covariances)
    except np.linalg.LinAlgError:
        return False
    return True
