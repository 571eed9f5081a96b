"""The detector: from an image to identified markers with sub-pixel corners.

segment (squares in the image) -> decode (which marker) -> choose (one per place) -> exact
(where exactly).
"""

from collections.abc import Iterable, Iterator
from functools import cached_property

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.again import NOWHERE, Box, again
from tagmetry.detect.choose import (
    Candidate,
    Rules,
    best_per_place,
    distinct_rejections,
    with_duplicates_marked,
)
from tagmetry.detect.detection import Detection, Findings, Rejection
from tagmetry.detect.exact import exact_corners
from tagmetry.detect.expected import expected_picture
from tagmetry.detect.grey import grey_8bit
from tagmetry.detect.places import one_per_place
from tagmetry.detect.reading.decode import read
from tagmetry.detect.segment import DOUBLE_BELOW_PX, Squares, squares, squares_at_a_glance
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, BoolArray, GreyPixels
from tagmetry.markers import Layout, MarkerFamily, family

_BORDER_PX = 2.0
_LOOKS_AGAIN = 3


class Detector:
    """Finds markers of one or several families.

    Args:
        families: Names, or families of your own.
        forgive_bits: Wrong bits to forgive, for all families; by default each family's own
            `forgiven_bits`. More than a family's `correction_bits` gives nearest codes, not ids.
        inverted: Look for markers printed white on black as well.
        min_side_px: Sides of markers shorter than this are not looked for; by default 8 in images
            of up to half a megapixel, 16 in those of two to eight, and more in larger ones.
            A glance finds few below 10; those are looked for thoroughly where it finds no marker,
            or one of less than twice this side.
    """

    def __init__(
        self,
        families: Iterable[str | MarkerFamily] = ("tag36h11",),
        *,
        forgive_bits: int | None = None,
        inverted: bool = False,
        min_side_px: float | None = None,
    ) -> None:
        self.families = tuple(family(f) if isinstance(f, str) else f for f in families)
        if not self.families:
            raise InputError("a detector needs at least one marker family")
        if forgive_bits is not None and forgive_bits < 0:
            raise InputError(f"forgive_bits must be 0 or more, got {forgive_bits}")
        if min_side_px is not None and not (np.isfinite(min_side_px) and min_side_px >= 4):
            raise InputError(f"min_side_px must be at least 4, got {min_side_px}")
        self.rules = Rules(forgive_bits, inverted)
        self.min_side_px = min_side_px

    def detect(self, image: AnyPixels, camera: Camera | None = None) -> tuple[Detection, ...]:
        """Return the markers in an image, ordered by family and id.

        Args:
            image: Grey or BGR, uint8 or uint16, shape (h, w) or (h, w, 3).
            camera: Intrinsics of the image; sides are then followed along the curves that the lens
                makes of them.
        """
        grey = self._checked(image, camera)
        return _detections(grey, self._candidates(grey), camera)

    def explain(self, image: AnyPixels, camera: Camera | None = None) -> Findings:
        """Return the markers, and the squares that were turned down, each with the reason."""
        grey = self._checked(image, camera)
        found = squares(grey, self.min_side_px or default_min_side_px(grey.size), bright=True)
        judged = list(self._judged(grey, found))
        candidates = [verdict for _, verdict in judged if isinstance(verdict, Candidate)]
        rejections = [Rejection(at, reason) for at, reason in judged if isinstance(reason, str)]
        detections = _detections(grey, best_per_place(candidates), camera)
        return Findings(detections, distinct_rejections(rejections, detections))

    @staticmethod
    def _checked(image: AnyPixels, camera: Camera | None) -> GreyPixels:
        grey = grey_8bit(image)
        if camera is not None:
            camera.check_image(grey.shape[1], grey.shape[0])
        return grey

    @cached_property
    def _families_by_layout(self) -> dict[Layout, list[MarkerFamily]]:
        grouped: dict[Layout, list[MarkerFamily]] = {}
        for one in self.families:
            grouped.setdefault(one.layout, []).append(one)
        return grouped

    def _candidates(self, grey: GreyPixels) -> list[Candidate]:
        """Return the markers: at a glance, then thoroughly where that is worth it."""
        least_px = self.min_side_px or default_min_side_px(grey.size)
        found = squares_at_a_glance(grey, least_px, bright=self._bright)
        candidates, pictures_px = self._read(grey, found)
        candidates = best_per_place(candidates)
        looked_at, small_px = NOWHERE, least_px if least_px < DOUBLE_BELOW_PX else 0.0
        for _ in range(_LOOKS_AGAIN):
            markers_px = np.array([one.corners_px for one in candidates]).reshape(-1, 4, 2)
            squares_px, shape = found.corners_px, grey.shape
            box = again(markers_px, pictures_px, squares_px, shape, small_px, looked_at)
            if box is None:
                break
            found = self._squares_within(grey, box, least_px)
            more, pictures_px = self._read(grey, found)
            candidates, looked_at = best_per_place(candidates + more), box
        return candidates

    def _squares_within(self, grey: GreyPixels, box: Box, least_px: float) -> Squares:
        """Return the squares of all looks in a part of an image."""
        part = np.ascontiguousarray(grey[box.rows_and_columns])
        found = squares(part, max(least_px, box.least_px), bright=self._bright)
        return found.moved(box.left_px, box.top_px)

    @property
    def _bright(self) -> bool:
        """Whether bright squares on dark are looked for too."""
        return self.rules.inverted or self._has_white_borders

    @cached_property
    def _has_white_borders(self) -> bool:
        return any(layout.white_border for layout in self._families_by_layout)

    def _judged(self, grey: GreyPixels, found: Squares) -> Iterator[tuple[Array, Candidate | str]]:
        """Give every square, and the marker that it shows or the reason why it shows none."""
        for layout, families in self._families_by_layout.items():
            readings = read(grey, found.corners_px, layout)
            for corners_px, is_bright, reading in zip(
                found.corners_px, found.is_bright, readings, strict=True
            ):
                yield corners_px, self.rules.judge(corners_px, bool(is_bright), reading, families)

    def _read(self, grey: GreyPixels, found: Squares) -> tuple[list[Candidate], Array]:
        """Return the squares that read as markers, and where there is a picture in a border."""
        candidates: list[Candidate] = []
        pictures_px = [np.empty((0, 4, 2))]
        for layout, families in self._families_by_layout.items():
            here = self.rules.inverted | (found.is_bright == layout.white_border)
            corners_px, is_bright = found.corners_px[here], found.is_bright[here]
            readings = read(grey, corners_px, layout)
            candidates += self.rules.markers_among(corners_px, is_bright, readings, families)
            pictures_px.append(corners_px[readings.pictured])
        return candidates, one_per_place(np.concatenate(pictures_px))


def _detections(
    grey: GreyPixels, candidates: list[Candidate], camera: Camera | None
) -> tuple[Detection, ...]:
    if not candidates:
        return ()
    corners_px = np.stack([candidate.corners_px for candidate in candidates])
    pictures = [
        expected_picture(grey, one.corners_px, one.match.family, one.match.id) for one in candidates
    ]
    refined = exact_corners(grey, corners_px, pictures, camera)
    at_border = _touch_border(refined.corners_px, grey)
    detections = [
        Detection(
            candidate.match.family.name,
            candidate.match.id,
            refined.corners_px[i],
            refined.covariances_px2[i],
            candidate.match.hamming,
            candidate.match.confidence,
            candidate.is_inverted,
            bool(at_border[i]),
        )
        for i, candidate in enumerate(candidates)
    ]
    return with_duplicates_marked(detections)


def default_min_side_px(pixel_count: int) -> float:
    """Return the shortest side of markers that an image is searched for unless told otherwise."""
    small_px, large_px = np.sqrt([pixel_count / 5e5, pixel_count / 2e6])
    return 8.0 * max(1.0, min(2.0, float(small_px)), float(large_px))


def _touch_border(corners_px: Array, grey: GreyPixels) -> BoolArray:
    """Say of each marker (n, 4, 2) whether a corner lies at the image's edge, shape (n,)."""
    last_px = np.array([grey.shape[1] - 1, grey.shape[0] - 1])
    near = np.minimum(corners_px, last_px - corners_px) < _BORDER_PX
    return np.asarray(near.any(axis=(1, 2)))
