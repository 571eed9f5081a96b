"""Where new markers are looked for in which image, so that all places and sizes have their turn.

Small markers are looked for at full scale in narrow strips of rows, larger ones at half scale in
wider strips, the largest in the whole image at an eighth. Strips overlap by more than the largest
marker that they are for, whichever way it is turned.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

_SMALL_BELOW_PX = 32.0  # sides
_MIDDLE_BELOW_PX = 128.0
_LARGE_SCALE = 0.25  # at which markers of that side are 32 px large
_SLACK = 1.2  # sizes overlap by this factor
_DIAGONAL = 1.42
_MOVING_PX = 16  # a marker may move while strips pass over it
_FEWER = 4  # times fewer strips for the middle sizes


@dataclass(frozen=True)
class Turn:
    """What is looked for in one image.

    Attributes:
        top: First row.
        bottom: Past the last row.
        least_px: Shortest side of markers.
        scale: At which the image is looked at.
        small: Larger markers than those for which full scale is needed have a turn of their own.
    """

    top: int
    bottom: int
    least_px: float
    scale: float
    small: bool = False


@lru_cache
def turns(height_px: int, least_px: float, strips: int) -> tuple[Turn, ...]:
    """Return what is looked for in one image after another, until it begins anew.

    Args:
        height_px: Rows of the image.
        least_px: Shortest side of the smallest markers wanted.
        strips: How many strips small markers are looked for in, at most.
    """
    all_turns: list[Turn] = []
    if least_px < _SMALL_BELOW_PX:
        small = _strips(height_px, least_px, _SMALL_BELOW_PX, strips)
        all_turns += [replace(turn, small=True) for turn in small]
    middle_px = max(least_px, _SMALL_BELOW_PX)
    if middle_px < _MIDDLE_BELOW_PX:
        all_turns += _strips(height_px, middle_px, _MIDDLE_BELOW_PX, -(-strips // _FEWER))
    large_px = max(least_px, _MIDDLE_BELOW_PX)
    if height_px > _MIDDLE_BELOW_PX:
        all_turns.append(Turn(0, height_px, large_px, _LARGE_SCALE))
    return tuple(all_turns)


def _strips(height_px: int, least_px: float, largest_px: float, count: int) -> list[Turn]:
    """Return strips of rows that markers of some sizes fit into wherever they are."""
    overlap = round(_SLACK * _DIAGONAL * largest_px) + _MOVING_PX
    count = max(1, min(count, height_px // overlap))
    tops = [round(k * height_px / count) for k in range(count + 1)]
    return [
        Turn(top, min(bottom + overlap, height_px), least_px, 1.0) for top, bottom in pairwise(tops)
    ]
