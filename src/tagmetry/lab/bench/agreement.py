"""What is taken for true where nothing is known: what engines of two authors see alike.

Variants of one detector make the same mistakes; they count as one.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.bench.case import Truth
from tagmetry.lab.bench.matching import matched
from tagmetry.lab.bench.rounds import Course

_AUTHORS = 2


@dataclass(eq=False)
class _Sighting:
    """A marker as it was first seen, and all squares that were found there, by author."""

    id: int
    corners_px: Array
    by_author: dict[str, list[Array]] = field(default_factory=dict)

    @property
    def middle_px(self) -> Array:
        """The median over the authors of the median over each one's variants."""
        by_author = [np.median(squares, axis=0) for squares in self.by_author.values()]
        return np.asarray(np.median(by_author, axis=0))


def agreed(courses: Sequence[Course], images: int) -> tuple[Truth, ...]:
    """Return the markers of every image that engines of two authors see."""
    return tuple(_agreed(courses, number) for number in range(images))


def _agreed(courses: Sequence[Course], number: int) -> Truth:
    sightings: list[_Sighting] = []
    for course in courses:
        if number in course.found:
            _add(sightings, course, number)
    both = [one for one in sightings if len(one.by_author) >= _AUTHORS]
    return Truth(
        np.array([one.id for one in both], dtype=np.int64),
        np.array([one.middle_px for one in both]).reshape(-1, 4, 2),
    )


def _add(sightings: list[_Sighting], course: Course, number: int) -> None:
    """Put what an engine found to what was found before."""
    found = course.found[number]
    known = Truth(
        np.array([one.id for one in sightings], dtype=np.int64),
        np.array([one.corners_px for one in sightings]).reshape(-1, 4, 2),
    )
    pairs = matched(found, known)
    at = dict(zip(pairs.found.tolist(), pairs.true.tolist(), strict=True))
    for j, corners_px in enumerate(found.corners_px):
        if j not in at:
            at[j] = len(sightings)
            sightings.append(_Sighting(int(found.ids[j]), corners_px))
        by_author = sightings[at[j]].by_author
        by_author.setdefault(course.kind.author, []).append(corners_px)
