"""What is found, and how large it is."""

import numpy as np

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group

_FEW_PX_PER_CELL = 3.0


def check_found(evidence: Evidence) -> tuple[Advice, ...]:
    """Name the markers found, and those that are near the limit of size."""
    sizes = tuple(
        _near_the_limit(group) for group in evidence.found if _px_per_cell(group) < _FEW_PX_PER_CELL
    )
    return (*(_found(group) for group in evidence.found), *sizes)


def _found(group: Group) -> Advice:
    sides_px = [detection.side_px for detection in group.detections]
    low, high = round(min(sides_px)), round(max(sides_px))
    sides = f"{low} px" if low == high else f"{low} to {high} px"
    return Advice("ok", "found", f"{group}, sides of {sides}")


def _px_per_cell(group: Group) -> float:
    smallest_px = min(detection.side_px for detection in group.detections)
    return float(smallest_px / group.family.layout.side_cells)


def _near_the_limit(group: Group) -> Advice:
    px_per_cell = np.array([d.side_px for d in group.detections]) / group.family.layout.side_cells
    few = int((px_per_cell < _FEW_PX_PER_CELL).sum())
    return Advice(
        "hint",
        "small markers",
        f"{few} of {len(px_per_cell)} markers of {group.family.name} have less than "
        f"{_FEW_PX_PER_CELL:g} pixels per cell (the smallest {px_per_cell.min():.1f}): "
        "they may be lost in the next picture",
        f"come up to {_FEW_PX_PER_CELL / px_per_cell.min():.1f} times nearer, zoom in, print "
        "larger, or take more resolution",
    )
