"""Dark squares in a grey image, found by kernels that look at each pixel a few times only.

tiles (what is dark here?) -> mask -> runs -> components (which belong together, which may be a
marker) -> outline (walked once around each) -> corners (four lines) -> squares (all passes).
"""

from tagmetry.detect.segment.squares import Squares, squares

__all__ = ["Squares", "squares"]
