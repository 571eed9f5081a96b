"""What a marker is fitted to, and room for the work."""

from typing import NamedTuple

from tagmetry.detect.photometric.kernel import Narrow
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels


class View(NamedTuple):
    """One marker in an image.

    Attributes:
        grey: The image.
        frame: Middle x, y and half diagonal of the marker, pixels.
        lens: See `straight_place`.
        room: See `block`.
        pixels: Chosen pixels, block after block, shape (MOST_BLOCKS, READ).
    """

    grey: GreyPixels
    frame: Array
    lens: Array
    room: Narrow
    pixels: Narrow
