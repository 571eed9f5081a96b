"""Dark squares in a grey image, found by kernels that look at each pixel a few times only.

tiles (what is dark here?) -> dark (a bit each) -> starts (where may an outline begin?) -> outline
(walked once around each) -> corners (four lines) -> look (all of these) -> squares (all looks).
"""

from tagmetry.detect.segment.squares import (
    DOUBLE_BELOW_PX,
    TURNS,
    Squares,
    squares,
    squares_at_a_glance,
    squares_in_turn,
)

__all__ = [
    "DOUBLE_BELOW_PX",
    "TURNS",
    "Squares",
    "squares",
    "squares_at_a_glance",
    "squares_in_turn",
]
