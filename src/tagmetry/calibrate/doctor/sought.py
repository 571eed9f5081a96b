"""Markers in pictures: of the family asked for, and of any other where there are none."""

from collections.abc import Sequence

from tagmetry.detect import Detection, Detector
from tagmetry.detect.doctor.groups import every_family, grouped, other_border
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import MarkerFamily, family

Markers = tuple[Detection, ...]

_ENOUGH = 4
_MOST_PICTURES = 2  # in which every family is looked for


def markers_of(greys: Sequence[GreyPixels], name: str) -> list[Markers]:
    """Return the markers of a family in each picture, also white on black.

    A family whose border is of the other width may win a place: its markers are no others.
    """
    wanted = family(name)
    twin = other_border(wanted)
    detector = Detector([wanted, twin] if twin else [wanted], inverted=True)
    return [
        tuple(d for d in detector.detect(grey) if d.family == wanted.name and not d.is_duplicate)
        for grey in greys
    ]


def other_family(greys: Sequence[GreyPixels]) -> MarkerFamily | None:
    """Return the family of which markers are seen beyond doubt, None where there is none."""
    every = every_family()
    detector = Detector(every, inverted=True)
    seen = [one for grey in greys[:_MOST_PICTURES] for one in detector.detect(grey)]
    sure = [group for group in grouped(seen, every) if group.is_sure()]
    best = max(sure, key=lambda group: group.evidence, default=None)
    return best.family if best is not None and len(best.ids) >= _ENOUGH else None
