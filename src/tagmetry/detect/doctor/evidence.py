"""What the checks look at: one image, and what is found in it in several ways."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.detect.detection import Detection, Findings
from tagmetry.detect.detector import Detector
from tagmetry.detect.doctor.groups import Group, every_family, grouped, other_border
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import MarkerFamily

_LEAST_SIDE_PX = 6.0
_ALL_BITS = 10_000  # forgive every wrong bit: any square with a border passes


@dataclass(frozen=True, eq=False)
class Evidence:
    """One image and what is to be found in it.

    Attributes:
        grey: The image, shape (h, w), uint8.
        wanted: Families asked for; none stands for whatever is there.
    """

    grey: GreyPixels
    wanted: tuple[MarkerFamily, ...]

    @property
    def families(self) -> tuple[MarkerFamily, ...]:
        """The families asked for, or all."""
        return self.wanted or every_family()

    @cached_property
    def findings(self) -> Findings:
        """What a detector of the wanted families says."""
        return Detector(self.families).explain(self.grey)

    @cached_property
    def found(self) -> tuple[Group, ...]:
        """Markers of the wanted families; where none are named, those that are no accident."""
        if not self.wanted:
            groups = grouped(self.findings.detections, self.families)
            return tuple(group for group in groups if group.is_sure())
        names = {one.name for one in self.wanted}
        own = [one for one in self._in_both_borders if one.family in names]
        return grouped(own, self.wanted)

    @cached_property
    def _in_both_borders(self) -> tuple[Detection, ...]:
        """What is found where a border of the other width may win a place."""
        if not self.findings.detections:
            return ()
        known = {one.name for one in self.wanted}
        twins = [other for one in self.wanted if (other := other_border(one))]
        new = [one for one in twins if one.name not in known]
        return Detector((*self.wanted, *new)).detect(self.grey)

    @cached_property
    def present(self) -> tuple[Group, ...]:
        """Markers of any family, also white on black, where no wanted one was found."""
        every = every_family()
        seen = Detector(every, inverted=True).detect(self.grey)
        return grouped(outside(seen, detections_of(self.found)), every)

    @cached_property
    def others(self) -> tuple[Group, ...]:
        """Those of `present` that are no accident."""
        return tuple(group for group in self.present if group.is_sure())

    @cached_property
    def squares(self) -> tuple[Detection, ...]:
        """Squares with a dark border that are no marker found above, each read as the nearest."""
        loose = Detector(self.families, forgive_bits=_ALL_BITS, min_side_px=_LEAST_SIDE_PX)
        known = detections_of((*self.found, *self.others))
        return outside(loose.detect(self.grey), known)


def detections_of(groups: Sequence[Group]) -> tuple[Detection, ...]:
    """Return all markers of groups."""
    return tuple(detection for group in groups for detection in group.detections)


def outside(detections: Sequence[Detection], taken: Sequence[Detection]) -> tuple[Detection, ...]:
    """Return those whose centre lies farther than a side from the centres of all others."""
    return tuple(
        one
        for one in detections
        if all(np.linalg.norm(one.center_px - other.center_px) > other.side_px for other in taken)
    )
