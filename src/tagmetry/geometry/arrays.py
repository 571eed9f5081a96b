"""The array types that the signatures of this package speak of."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
GreyPixels = NDArray[np.uint8]  # (height, width)
AnyPixels = NDArray[Any]  # what a camera or a file gives, before it is checked
