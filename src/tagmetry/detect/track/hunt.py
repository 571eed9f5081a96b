"""Which parts of an image are searched: around lost markers, and one turn's part for new ones."""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.places import side_lengths
from tagmetry.detect.track.greyed import boxes_around
from tagmetry.detect.track.known import Known
from tagmetry.detect.track.strips import Turn
from tagmetry.geometry.arrays import BoolArray, IntArray

_SHORTER = 0.6  # lost markers are looked for down to this share of the expected side
_EVERY_LOOK_PX = 30.0  # for larger ones an image is looked at less closely
_MOST = 0.5  # of the image; where more should be searched, all of it is


@dataclass(frozen=True, eq=False)
class Part:
    """A part of an image to search.

    Attributes:
        box: Left, top, and past the right and bottom, shape (4,).
        least_px: Shortest side of markers.
        scale: At which it is looked at, 1 or less.
        looks: Which turn of looks is taken; all where None.
        small: Only markers for which full scale is needed are looked for.
    """

    box: IntArray
    least_px: float
    scale: float = 1.0
    looks: int | None = None
    small: bool = False


def whole(size_px: tuple[int, int], least_px: float) -> Part:
    """Return all of an image, (width, height), as one part."""
    return Part(np.array([0, 0, *size_px]), least_px)


def turn_part(turn: Turn, width_px: int, looks: int) -> Part:
    """Return what is searched for new markers in one image."""
    box = np.array([0, turn.top, width_px, turn.bottom])
    return Part(box, turn.least_px, turn.scale, looks, turn.small)


def due(missed: IntArray) -> BoolArray:
    """Say which lost markers are searched for, by the images that did not show them before.

    At once, and after 1, 2, 4, 8 … images: whoever is covered for long costs little.
    """
    return np.asarray((missed & (missed - 1)) == 0)


def parts_around(
    known: Known, is_lost: BoolArray, size_px: tuple[int, int], least_px: float
) -> list[Part]:
    """Return what is searched for lost markers.

    Args:
        known: The markers that are looked for, n.
        is_lost: Which were not seen where they should be, shape (n,).
        size_px: (width, height) of the image.
        least_px: Shorter sides are looked for nowhere.
    """
    wanted = is_lost & due(known.tracks.missed)
    if not wanted.any():
        return []
    corners_px = known.corners_px[wanted]
    boxes = boxes_around(corners_px, known.reach_px[wanted], size_px)
    areas = (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    if areas.sum() > _MOST * size_px[0] * size_px[1]:
        return [whole(size_px, least_px)]
    shorter_px = np.minimum(_SHORTER * side_lengths(corners_px).min(axis=1), _EVERY_LOOK_PX)
    leasts_px = np.maximum(shorter_px, least_px)
    return [Part(box, float(shortest)) for box, shortest in zip(boxes, leasts_px, strict=True)]
