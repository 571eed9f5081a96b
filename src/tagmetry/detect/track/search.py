"""The search for markers that are not followed: around lost ones, and for new ones part by part."""

import cv2
import numpy as np

from tagmetry.detect.candidates import Candidates
from tagmetry.detect.detector import Detector, default_min_side_px
from tagmetry.detect.places import in_places
from tagmetry.detect.reader import Reader
from tagmetry.detect.segment import TURNS, Squares, squares, squares_in_turn
from tagmetry.detect.track.greyed import Greyed
from tagmetry.detect.track.hunt import Part, parts_around, turn_part, whole
from tagmetry.detect.track.known import Known
from tagmetry.detect.track.rota import Rota
from tagmetry.detect.track.strips import Turn, turns
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_LEAST_PART_PX = 8


class Search:
    """Says what is searched in which image, and finds the markers there.

    Args:
        detector: What to look for.
        strips: Into how many strips of rows the image is cut to look for new small markers.
        acquire_s: How soon all of the image is to be searched.
    """

    def __init__(self, detector: Detector, strips: int, acquire_s: float) -> None:
        self._detector, self._strips, self._acquire_s = detector, strips, acquire_s
        self._rota: Rota | None = None

    def begin_anew(self) -> None:
        """Look at all of the next image."""
        self._rota = None

    def plan(self, size_px: tuple[int, int]) -> tuple[Turn, ...]:
        """Return the turns of the search in images of a size, (width, height)."""
        return turns(size_px[1], self._least_px(size_px), self._strips)

    def parts(
        self,
        known: Known,
        is_lost: BoolArray,
        size_px: tuple[int, int],
        time_s: float,
        since_s: float,
    ) -> list[Part]:
        """Return what is searched in an image; the rota moves on.

        Args:
            known: The markers that are looked for, n.
            is_lost: Which were not seen where they should be, shape (n,).
            size_px: (width, height) of the image.
            time_s: Its time.
            since_s: Time since the image before.
        """
        around = parts_around(known, is_lost, size_px, self._least_px(size_px))
        return around + self._new_parts(size_px, time_s, since_s)

    def found(self, image: Greyed, parts: list[Part], known_px: Array) -> Candidates:
        """Return the markers in parts of an image, in the image's pixels.

        Args:
            image: The image.
            parts: Where, and at what scale.
            known_px: Squares whose places are not looked at, shape (n, 4, 2).
        """
        found = Candidates.none()
        for part in parts:
            found = found.and_also(_found_in(image, part, self._detector.reader, known_px))
        return found.best_per_place()

    def _new_parts(self, size_px: tuple[int, int], time_s: float, since_s: float) -> list[Part]:
        """Return what is searched for new markers: all, one part or none; the rota moves on."""
        if self._rota is None:
            self._rota = Rota.begun(time_s)
            return [whole(size_px, self._least_px(size_px))]
        if time_s < self._rota.due_s:
            return []
        plan = self.plan(size_px)
        rounds, place = divmod(self._rota.turn, len(plan))
        self._rota = self._rota.after(time_s, since_s, self._acquire_s, len(plan))
        return [turn_part(plan[place], size_px[0], rounds % TURNS)]

    def _least_px(self, size_px: tuple[int, int]) -> float:
        return self._detector.min_side_px or default_min_side_px(size_px[0] * size_px[1])


def _found_in(image: Greyed, part: Part, reader: Reader, known_px: Array) -> Candidates:
    """Return the markers in a part of an image, in the image's pixels.

    Args:
        image: The image.
        part: Which part, and at what scale.
        reader: What is looked for.
        known_px: Squares whose places are not looked at, shape (n, 4, 2).
    """
    left, top, right, bottom = part.box.tolist()
    if min(right - left, bottom - top) * part.scale < _LEAST_PART_PX:
        return Candidates.none()
    grey = _scaled(image.look_at(part.box[None])[top:bottom, left:right], part.scale)
    found = _squares(grey, part, bright=reader.bright)
    corners_px = (found.corners_px + 0.5) / part.scale - 0.5 + [left, top]
    free = ~in_places(corners_px, known_px)
    if not free.any():
        return Candidates.none()
    return reader.read(image.grey, Squares(corners_px[free], found.is_bright[free])).candidates


def _squares(grey: GreyPixels, part: Part, *, bright: bool) -> Squares:
    """Return the squares of a part, in its own pixels."""
    least_px = part.scale * part.least_px
    if part.looks is None:
        return squares(grey, least_px, bright=bright)
    return squares_in_turn(grey, least_px, part.looks, bright=bright, small=part.small)


def _scaled(part: GreyPixels, scale: float) -> GreyPixels:
    if scale == 1.0:
        return np.ascontiguousarray(part)
    step = round(1 / scale)
    size = (part.shape[1] // step, part.shape[0] // step)
    whole = part[: size[1] * step, : size[0] * step]
    return np.asarray(cv2.resize(whole, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
