"""The board's own markers in a picture, without strangers and misread ones."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tagmetry.calibrate.targets.homography import fitted_homography
from tagmetry.detect import Detection, Detector
from tagmetry.geometry import Array, apply_homography
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray
from tagmetry.markers import Board

_FEW = 2
_FARTHEST = 0.6  # sides of a marker: how far a corner may be off; leaves room for distortion


@dataclass(frozen=True, eq=False)
class SeenMarkers:
    """Markers of a board.

    Attributes:
        places: Which of `board.markers()` they are, shape (n,), rising.
        corners_px: Shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        agree: Whether each lies where the others say, shape (n,).
    """

    places: IntArray
    corners_px: Array
    covariances_px2: Array
    agree: BoolArray

    def agreeing(self) -> "SeenMarkers":
        """Return those that lie where the others say."""
        kept = self.agree
        return SeenMarkers(
            self.places[kept], self.corners_px[kept], self.covariances_px2[kept], kept[kept]
        )


def see_markers(grey: GreyPixels, board: Board) -> SeenMarkers:
    """Return the markers of a board that a picture shows.

    Boards printed white on black are looked for where there are none black on white.
    """
    wanted = {marker.id: place for place, marker in enumerate(board.markers())}
    name = board.markers()[0].family
    detections = _of_board(_detector(name, inverted=False).detect(grey), wanted)
    if len(detections) < _FEW:
        inverted = _of_board(_detector(name, inverted=True).detect(grey), wanted)
        detections = max(detections, inverted, key=len)
    detections.sort(key=lambda one: wanted[one.id])
    places = np.array([wanted[one.id] for one in detections], dtype=np.int64)
    corners_px = np.array([one.corners_px for one in detections]).reshape(-1, 4, 2)
    covariances = np.array([one.corners_cov_px2 for one in detections]).reshape(-1, 8, 8)
    agree = off_plane(board, places, corners_px) < _FARTHEST
    return SeenMarkers(places, corners_px, covariances, agree)


def off_plane(board: Board, places: IntArray, corners_px: Array) -> Array:
    """Return how far markers lie from where one view of the flat board puts them, shape (n,).

    It is the distance of a marker's worst corner, in sides of a marker.
    """
    if len(places) < _FEW:
        return np.zeros(len(places))
    markers = board.markers()
    corners_m = np.concatenate([markers[place].corners_m[:, :2] for place in places])
    sides_px = np.linalg.norm(np.roll(corners_px, -1, axis=1) - corners_px, axis=2).mean(axis=1)
    side_px = float(np.median(sides_px))
    H = fitted_homography(corners_m, corners_px.reshape(-1, 2), _FARTHEST * side_px)
    expected = apply_homography(H, corners_m).reshape(corners_px.shape)
    off_px = np.linalg.norm(expected - corners_px, axis=2).max(axis=1)
    return np.asarray(np.nan_to_num(off_px, nan=np.inf) / side_px)


@lru_cache(maxsize=16)
def _detector(family: str, *, inverted: bool) -> Detector:
    return Detector([family], inverted=inverted)


def _of_board(detections: tuple[Detection, ...], wanted: dict[int, int]) -> list[Detection]:
    return [one for one in detections if one.id in wanted and not one.is_duplicate]
