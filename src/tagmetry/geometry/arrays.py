"""The array types that the signatures of this package speak of."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]
FloatImage = NDArray[np.float32]  # (height, width), light or grey values before rounding
GreyPixels = NDArray[np.uint8]  # (height, width)
AnyPixels = NDArray[Any]  # what a camera or a file gives, before it is checked
