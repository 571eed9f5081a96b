"""How the loops over pixels are compiled: to disk, without the GIL, divisions by zero give inf.

Loops over pixels compute with 32 bits, twice as many pixels at once as with 64: a place is then
good to 1e-7 of the marker, a value to 1e-7 of white, far below noise. What is solved for has 64.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Narrow = NDArray[np.float32]  # what loops over pixels read and write
Whole = NDArray[np.int32]  # numbers of places, as wide
f32 = (
    np.float32
)  # around every number in a loop over pixels: one of 64 bits makes its result so too

_FLAGS = {"contract", "reassoc", "arcp", "nsz"}

kernel = njit(cache=True, nogil=True, error_model="numpy", fastmath=_FLAGS)

# A step of a page, written into its caller before that is compiled. Every kernel that calls another
# compiles that one's code again, so that pages that call pages would take minutes.
step = njit(inline="always", nogil=True, error_model="numpy", fastmath=_FLAGS)
