"""What is said of a marker that was followed and is not seen in this image."""

from dataclasses import dataclass

from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Lost:
    """A marker that is still looked for where it should be.

    Attributes:
        family: Name of its family.
        id: Its id.
        corners_px: Where it is expected in the last image, shape (4, 2); nothing was seen there.
        deviation_px: How far it may be from there, standard deviation.
        age_s: For how long it has not been seen.
    """

    family: str
    id: int
    corners_px: Array
    deviation_px: float
    age_s: float
