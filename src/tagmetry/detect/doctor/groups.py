"""Markers of one family, seen together: how sure is it that they are no accident?

Texture passes for a marker of a small family now and then. The chance that random bits do is known
for each family, so a group of ids carries evidence: minus the decimal logarithm of that chance,
summed over the ids.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import log10

import numpy as np

from tagmetry.detect.detection import Detection
from tagmetry.markers import MarkerFamily, family, family_names

_SURE = 5.0  # decades: two markers of 4x4_50, one of tag25h9
_LEAST_CONFIDENCE = 0.4
_AS_CLEAR = 0.8
_TELLING = 1e-5  # chance of a code of so many bits that it tells by itself
_SUBSET = re.compile(r"^(?P<kind>\dx\d)_(?P<count>50|100|250|1000)(?P<border>_border\d)?$")
_MOST_IDS_SHOWN = 12


@dataclass(frozen=True)
class Group:
    """Markers of one family, all inverted or none.

    Attributes:
        family: The smallest predefined family that has all the ids.
        detections: The markers, at least one.
    """

    family: MarkerFamily
    detections: tuple[Detection, ...]

    @property
    def ids(self) -> tuple[int, ...]:
        """Distinct ids, rising."""
        return tuple(sorted({detection.id for detection in self.detections}))

    @property
    def is_inverted(self) -> bool:
        """Whether they are printed white on black."""
        return self.detections[0].is_inverted

    @property
    def evidence(self) -> float:
        """Decades by which the group is unlikely to be an accident."""
        best = {
            d.id: min(e.hamming for e in self.detections if e.id == d.id) for d in self.detections
        }
        chances = [self.family.chance_of_random_match(hamming) for hamming in best.values()]
        return float(-np.log10(np.maximum(chances, 1e-12)).sum())

    def is_sure(self, tries: int = 1) -> bool:
        """Say whether it is no accident, after some number of tries to find one."""
        return self.evidence - log10(max(1, tries)) >= _SURE

    def __str__(self) -> str:
        """Name the family and its ids."""
        shown = ", ".join(str(one) for one in self.ids[:_MOST_IDS_SHOWN])
        more = len(self.ids) - _MOST_IDS_SHOWN
        rest = f" and {more} more" if more > 0 else ""
        return f"{self.family.name} id{'s' if len(self.ids) > 1 else ''} {shown}{rest}"


def grouped(detections: Sequence[Detection], known: Sequence[MarkerFamily]) -> tuple[Group, ...]:
    """Return the groups of clear markers, the surest first.

    Args:
        detections: Markers of any families.
        known: The families they were looked for in.
    """
    by_name = {one.name: one for one in known}
    gathered: dict[tuple[str, bool], list[Detection]] = {}
    for one in detections:
        if one.confidence >= _LEAST_CONFIDENCE:
            gathered.setdefault((one.family, one.is_inverted), []).append(one)
    groups = [_group(by_name[name], found) for (name, _), found in gathered.items()]
    return tuple(sorted(groups, key=lambda group: -group.evidence))


def _group(found_in: MarkerFamily, found: Sequence[Detection]) -> Group:
    """Return the group, without those that are much less clear than the clearest of few bits."""
    least = max(one.confidence for one in found) * _AS_CLEAR
    if found_in.chance_of_random_match(0) > _TELLING:
        found = [one for one in found if one.confidence >= least]
    return Group(_smallest(found_in, max(one.id for one in found)), tuple(found))


def every_family() -> tuple[MarkerFamily, ...]:
    """Return all predefined families with borders of one and two cells, without subsets."""
    names = [name for name in family_names() if not name.endswith(("_50", "_100", "_250"))]
    plain = [family(name) for name in names]
    return (*plain, *(one.with_border(2) for one in plain if not one.layout.white_border))


def other_border(one: MarkerFamily) -> MarkerFamily | None:
    """Return the family with a border of two cells instead of one or the reverse, if there is."""
    plain, _, border = one.name.partition("_border")
    if one.layout.white_border:
        return None
    if not border and one.layout.border_cells == 1:
        return one.with_border(2)
    return family(plain) if plain in family_names() else None


def _smallest(found: MarkerFamily, highest_id: int) -> MarkerFamily:
    """Return the smallest family that `found` begins with and that has the id."""
    match = _SUBSET.match(found.name)
    if match is None:
        return found
    fitting = [count for count in (50, 100, 250, 1000) if highest_id < count <= int(match["count"])]
    return family(f"{match['kind']}_{fitting[0]}{match['border'] or ''}")
