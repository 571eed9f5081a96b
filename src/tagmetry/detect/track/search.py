"""Markers in a part of an image, as a detector finds them, but for their exact corners."""

from collections.abc import Sequence

import cv2
import numpy as np

from tagmetry.detect.choose import Candidate, Rules, best_per_place
from tagmetry.detect.places import in_places
from tagmetry.detect.reading.decode import read
from tagmetry.detect.segment import Squares, squares, squares_in_turn
from tagmetry.detect.track.greyed import Greyed
from tagmetry.detect.track.hunt import Part
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels
from tagmetry.markers import Layout, MarkerFamily

_LEAST_PART_PX = 8


class Search:
    """Looks for markers in parts of an image.

    Args:
        families: What is looked for.
        rules: What passes for a marker.
    """

    def __init__(self, families: Sequence[MarkerFamily], rules: Rules) -> None:
        self._rules = rules
        self._by_layout: dict[Layout, list[MarkerFamily]] = {}
        for one in families:
            self._by_layout.setdefault(one.layout, []).append(one)
        self._bright = rules.inverted or any(layout.white_border for layout in self._by_layout)

    def candidates(self, image: Greyed, part: Part, known_px: Array) -> list[Candidate]:
        """Return the markers in a part of an image, in the image's pixels.

        Args:
            image: The image.
            part: Which part, and at what scale.
            known_px: Squares whose places are not looked at, shape (n, 4, 2).
        """
        left, top, right, bottom = part.box
        if min(right - left, bottom - top) * part.scale < _LEAST_PART_PX:
            return []
        grey = _scaled(image.look_at(part.box[None])[top:bottom, left:right], part.scale)
        found = self._squares(grey, part.scale * part.least_px, part.looks)
        corners_px = (found.corners_px + 0.5) / part.scale - 0.5 + [left, top]
        free = ~in_places(corners_px, known_px)
        judged = self._judged(image.grey, corners_px[free], found.is_bright[free])
        return best_per_place(judged)

    def _squares(self, grey: GreyPixels, least_px: float, looks: int | None) -> Squares:
        if looks is None:
            return squares(grey, least_px, bright=self._bright)
        return squares_in_turn(grey, least_px, looks, bright=self._bright)

    def _judged(self, grey: GreyPixels, corners_px: Array, is_bright: BoolArray) -> list[Candidate]:
        """Read squares in every layout."""
        candidates: list[Candidate] = []
        for layout, families in self._by_layout.items():
            here = self._rules.inverted | (is_bright == layout.white_border)
            readings = read(grey, corners_px[here], layout)
            candidates += self._rules.markers_among(
                corners_px[here], is_bright[here], readings, families
            )
        return candidates


def _scaled(part: GreyPixels, scale: float) -> GreyPixels:
    if scale == 1.0:
        return np.ascontiguousarray(part)
    step = round(1 / scale)
    size = (part.shape[1] // step, part.shape[0] // step)
    whole = part[: size[1] * step, : size[0] * step]
    return np.asarray(cv2.resize(whole, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
