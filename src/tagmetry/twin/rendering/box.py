"""Rectangles of whole pixels."""

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Box:
    """Whole pixels, from (left, top) to before (right, bottom)."""

    left: int
    top: int
    right: int
    bottom: int

    def __bool__(self) -> bool:
        """Say whether there is a pixel in it."""
        return self.left < self.right and self.top < self.bottom

    def __and__(self, other: "Box") -> "Box":
        """Return what two boxes have in common."""
        return Box(
            max(self.left, other.left),
            max(self.top, other.top),
            min(self.right, other.right),
            min(self.bottom, other.bottom),
        )

    def __or__(self, other: "Box") -> "Box":
        """Return the box around two."""
        return Box(
            min(self.left, other.left),
            min(self.top, other.top),
            max(self.right, other.right),
            max(self.bottom, other.bottom),
        )

    @property
    def area_px(self) -> int:
        """How many pixels it has."""
        return max(self.right - self.left, 0) * max(self.bottom - self.top, 0)

    @property
    def pixels(self) -> tuple[slice, slice]:
        """Its rows and columns in the image."""
        return slice(self.top, self.bottom), slice(self.left, self.right)

    def grown(self, by_px: int) -> "Box":
        """Return it with a margin on every side."""
        return Box(self.left - by_px, self.top - by_px, self.right + by_px, self.bottom + by_px)

    def inside(self, outer: "Box", fine: int = 1) -> tuple[slice, slice]:
        """Return its rows and columns in a window of a box, `fine` points to a pixel."""
        return (
            slice(fine * (self.top - outer.top), fine * (self.bottom - outer.top)),
            slice(fine * (self.left - outer.left), fine * (self.right - outer.left)),
        )


def tiles(width_px: int, height_px: int, side_px: int) -> Iterator[Box]:
    """Give boxes that cover an image, side by side."""
    for top in range(0, height_px, side_px):
        for left in range(0, width_px, side_px):
            right, bottom = min(left + side_px, width_px), min(top + side_px, height_px)
            yield Box(left, top, right, bottom)
