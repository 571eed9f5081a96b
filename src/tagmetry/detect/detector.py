"""The detector: from an image to identified markers with sub-pixel corners.

segment (squares in the image) -> reader (which of them are markers) -> candidates (one per place)
-> exact (where exactly) -> report.
"""

from collections.abc import Iterable

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.again import NOWHERE, Box, again
from tagmetry.detect.candidates import Candidates
from tagmetry.detect.choose import Rules
from tagmetry.detect.detection import Detection, Findings
from tagmetry.detect.exact import exact_corners
from tagmetry.detect.expected import expected_pictures
from tagmetry.detect.grey import grey_8bit
from tagmetry.detect.reader import Reader
from tagmetry.detect.report import detections, distinct_rejections
from tagmetry.detect.segment import DOUBLE_BELOW_PX, Squares, squares, squares_at_a_glance
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.markers import MarkerFamily, family

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
        self.reader = Reader(self.families, self.rules)
        self.min_side_px = min_side_px

    def detect(self, image: AnyPixels, camera: Camera | None = None) -> tuple[Detection, ...]:
        """Return the markers in an image, ordered by family and id.

        Args:
            image: Grey or BGR, uint8 or uint16, shape (h, w) or (h, w, 3).
            camera: Intrinsics of the image; sides are then followed along the curves that the lens
                makes of them.
        """
        grey = self._checked(image, camera)
        return self._detections(grey, self._candidates(grey), camera)

    def explain(self, image: AnyPixels, camera: Camera | None = None) -> Findings:
        """Return the markers, and the squares that were turned down, each with the reason."""
        grey = self._checked(image, camera)
        found = squares(grey, self.min_side_px or default_min_side_px(grey.size), bright=True)
        candidates = self.reader.read(grey, found).candidates.best_per_place()
        detections = self._detections(grey, candidates, camera)
        rejections = self.reader.turned_down(grey, found)
        return Findings(detections, distinct_rejections(rejections, detections))

    @staticmethod
    def _checked(image: AnyPixels, camera: Camera | None) -> GreyPixels:
        grey = grey_8bit(image)
        if camera is not None:
            camera.check_image(grey.shape[1], grey.shape[0])
        return grey

    def _candidates(self, grey: GreyPixels) -> Candidates:
        """Return the markers: at a glance, then thoroughly where that is worth it."""
        least_px, shape = self.min_side_px or default_min_side_px(grey.size), grey.shape
        found = squares_at_a_glance(grey, least_px, bright=self.reader.bright)
        at_first, pictures_px = self.reader.read(grey, found)
        candidates = at_first.best_per_place()
        looked_at, small_px = NOWHERE, least_px if least_px < DOUBLE_BELOW_PX else 0.0
        for _ in range(_LOOKS_AGAIN):
            markers_px, squares_px = candidates.corners_px, found.corners_px
            box = again(markers_px, pictures_px, squares_px, shape, small_px, looked_at)
            if box is None:
                break
            found, looked_at = self._squares_within(grey, box, least_px), box
            more, pictures_px = self.reader.read(grey, found)
            candidates = candidates.and_also(more).best_per_place()
        return candidates

    def _squares_within(self, grey: GreyPixels, box: Box, least_px: float) -> Squares:
        """Return the squares of all looks in a part of an image."""
        part = np.ascontiguousarray(grey[box.rows_and_columns])
        found = squares(part, max(least_px, box.least_px), bright=self.reader.bright)
        return found.moved(box.left_px, box.top_px)

    def _detections(
        self, grey: GreyPixels, found: Candidates, camera: Camera | None
    ) -> tuple[Detection, ...]:
        if not len(found):
            return ()
        pictures = expected_pictures(grey, found, self.families)
        exact = exact_corners(grey, found.corners_px, pictures, camera)
        return detections(found, exact, self.families, (grey.shape[1], grey.shape[0]))


def default_min_side_px(pixel_count: int) -> float:
    """Return the shortest side of markers that an image is searched for unless told otherwise."""
    small_px, large_px = np.sqrt([pixel_count / 5e5, pixel_count / 2e6])
    return 8.0 * max(1.0, min(2.0, float(small_px)), float(large_px))
