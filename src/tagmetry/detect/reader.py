"""Squares read in every layout that is looked for: which are markers, and why others are not."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tagmetry.detect.candidates import Candidates
from tagmetry.detect.choose import Rules
from tagmetry.detect.detection import Rejection
from tagmetry.detect.reading.decode import read
from tagmetry.detect.segment import Squares
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import Layout, MarkerFamily


class Read(NamedTuple):
    """What squares show.

    Attributes:
        candidates: Those that are markers.
        pictures_px: Those with something printed in a border, shape (k, 4, 2).
    """

    candidates: Candidates
    pictures_px: Array


class Reader:
    """Reads squares as markers.

    Args:
        families: Of which families.
        rules: What passes for a marker.

    Attributes:
        bright: Whether bright squares on dark are wanted too.
    """

    def __init__(self, families: Sequence[MarkerFamily], rules: Rules) -> None:
        self._rules = rules
        self._by_layout: dict[Layout, dict[int, MarkerFamily]] = {}
        for place, one in enumerate(families):
            self._by_layout.setdefault(one.layout, {})[place] = one
        self.bright = rules.inverted or any(layout.white_border for layout in self._by_layout)

    def read(self, grey: GreyPixels, found: Squares) -> Read:
        """Return what squares of an image show."""
        candidates, pictures_px = Candidates.none(), []
        for layout, families in self._by_layout.items():
            here = self._rules.inverted | (found.is_bright == layout.white_border)
            corners_px, is_bright = found.corners_px[here], found.is_bright[here]
            readings = read(grey, corners_px, layout)
            more = self._rules.markers_among(corners_px, is_bright, readings, families)
            candidates = candidates.and_also(more)
            pictures_px.append(corners_px[readings.pictured])
        return Read(candidates, np.concatenate(pictures_px))

    def turned_down(self, grey: GreyPixels, found: Squares) -> list[Rejection]:
        """Return the squares of an image that are no markers, each in every layout, and why."""
        rejections = []
        for layout, by_place in self._by_layout.items():
            families, readings = list(by_place.values()), read(grey, found.corners_px, layout)
            squares = zip(found.corners_px, found.is_bright.tolist(), readings, strict=True)
            for corners_px, is_bright, reading in squares:
                reason = self._rules.why_not(is_bright, reading, families)
                if reason is not None:
                    rejections.append(Rejection(corners_px, reason))
        return rejections
