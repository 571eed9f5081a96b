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
    seen: list[SeenMarker] = []
    passed_over: dict[MarkerKey, str] = {}
    for detection in detections:
        key = MarkerKey(detection.family, detection.id)
        marker = marker_map.by_key.get(key)
        if marker is None:
            passed_over[key] = "it is not in the map"
        elif times[key] > 1:
            passed_over[key] = f"it was seen {times[key]} times in one image"
        elif not _is_usable(detection):
            passed_over[key] = "its corners or their covariance are no usable numbers"
        else:
            seen.append(SeenMarker(marker, detection))
    return KnownMarkers(tuple(seen), tuple(Rejection(*item) for item in passed_over.items()))


def _is_usable(detection: Detection) -> bool:
    corners, covariance = detection.corners_px, detection.corners_cov_px2
    is_whole = corners.shape == (4, 2) and covariance.shape == (8, 8)
    return is_whole and bool((np.abs(corners) < _FARTHEST_PX).all()) and _is_positive(covariance)


def _is_positive(covariance: Array) -> bool:
    if not np.isfinite(covariance).all():
        return False
    try:
        np.linalg.cholesky(covariance)
    except np.linalg.LinAlgError:
        return False
    return True
