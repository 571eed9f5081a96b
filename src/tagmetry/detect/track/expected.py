"""Which followed markers are where they should be?"""

from collections.abc import Sequence

import numpy as np

from tagmetry.detect.choose import Rules
from tagmetry.detect.places import side_lengths
from tagmetry.detect.track.blurred import recognised
from tagmetry.detect.track.greyed import Greyed, boxes_around
from tagmetry.detect.track.known import Known
from tagmetry.detect.track.seen import Seen
from tagmetry.detect.track.sight import look, nudge_reach_px
from tagmetry.geometry.arrays import IntArray
from tagmetry.markers import MarkerFamily

_AROUND_CELLS = 3.5  # pixels so far around a marker take part in measuring it
_AROUND_PX = 6.0
_LEAST_SIDE_PX = 4.0


def as_expected(
    image: Greyed,
    families: Sequence[MarkerFamily],
    rules: Rules,
    known: Known,
) -> Seen:
    """Return the followed markers that are seen close to where they are expected.

    Args:
        image: The image.
        families: Of the detector.
        rules: What passes for a marker.
        known: The markers that are looked for.
    """
    seen = Seen.nothing()
    for place in sorted(set(known.tracks.families.tolist())):
        rows = _within(known, place, image.size_px)
        if len(rows):
            seen = seen.and_also(_of_one_family(image, families, rules, known, rows))
    return seen.one_per_place()


def _within(known: Known, place: int, size_px: tuple[int, int]) -> IntArray:
    """Return the markers of a family whose middle should be in the image, and that are no speck."""
    middle = known.corners_px.mean(axis=1)
    inside = ((middle >= 0) & (middle <= np.array(size_px) - 1)).all(axis=1)
    large = side_lengths(known.corners_px).min(axis=1) >= _LEAST_SIDE_PX
    return np.flatnonzero((known.tracks.families == place) & inside & large)


def _of_one_family(
    image: Greyed,
    families: Sequence[MarkerFamily],
    rules: Rules,
    known: Known,
    rows: IntArray,
) -> Seen:
    place = int(known.tracks.families[rows[0]])
    family = families[place]
    corners_px, deviation_px = known.corners_px[rows], known.deviation_px[rows]
    cells = family.layout.side_cells
    grey = image.grey if image.is_whole else image.look_at(_around(image, known, rows, cells))
    is_inverted = known.tracks.is_inverted[rows]
    sights = look(grey, family, known.tracks.ids[rows], corners_px, deviation_px, is_inverted)
    forgiven = family.forgiven_bits if rules.forgive_bits is None else rules.forgive_bits
    there = sights.reads_as_expected(forgiven)
    if not there.all():
        there |= recognised(sights, ~there)
    return Seen.by_sight(sights, place, rows, is_inverted, there)


def _around(image: Greyed, known: Known, rows: IntArray, side_cells: int) -> IntArray:
    """Return what is looked at of an image to see and measure markers, boxes (n, 4)."""
    corners_px, deviation_px = known.corners_px[rows], known.deviation_px[rows]
    pad_px = _AROUND_CELLS * side_lengths(corners_px).max(axis=1) / side_cells + _AROUND_PX
    pad_px += nudge_reach_px(corners_px, deviation_px, side_cells)
    return boxes_around(corners_px, pad_px, image.size_px)
