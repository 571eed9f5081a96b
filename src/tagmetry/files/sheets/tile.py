"""What is cut out of a page: ink in its quiet zone, and a label below that says what it is.

Frame: as on a page, with the origin at the tile's own top left corner.
"""

from dataclasses import dataclass, replace

from tagmetry.files.sheets.page import Cells, Disc, Shape, Text, bar, text_width_m

LABEL_HEIGHT_M = 0.0045
_LARGEST_LABEL_M = 0.0030
_SMALLEST_LABEL_M = 0.0014


@dataclass(frozen=True)
class Tile:
    """A piece to cut out.

    Attributes:
        width_m: Its width, quiet zone included.
        inked_height_m: Its height without the label, quiet zone included.
        shapes: What is printed.
        size_name: The length that people choose: size, square.
        size_m: That length; the rest of the ink grows with it.
    """

    width_m: float
    inked_height_m: float
    shapes: tuple[Shape, ...]
    size_name: str
    size_m: float

    @property
    def height_m(self) -> float:
        """Its height with the label."""
        return self.inked_height_m + LABEL_HEIGHT_M

    def largest_size_m(self, width_m: float, height_m: float) -> float:
        """Return the size at which it would fit a room, 0 when none does."""
        across = width_m / self.width_m
        down = (height_m - LABEL_HEIGHT_M) / self.inked_height_m
        return max(0.0, min(across, down) * self.size_m)


def labelled(
    *,
    ink: tuple[Cells | Disc, ...],
    width_m: float,
    height_m: float,
    labels: tuple[str, ...],
    size_name: str,
    size_m: float,
    inverted: bool,
) -> Tile:
    """Return a tile.

    Args:
        ink: Black ink; white on a black ground when inverted.
        width_m: Width of the ink with its quiet zone.
        height_m: Height of the ink with its quiet zone.
        labels: What to write below, the first that fits; the last one is made to fit.
        size_name: What `size_m` is called.
        size_m: The length that people choose.
        inverted: Print white on black.
    """
    drawn = _inverted(ink, width_m, height_m) if inverted else ink
    label = _label(labels, width_m, height_m)
    return Tile(width_m, height_m, (*drawn, label), size_name, size_m)


def _inverted(
    ink: tuple[Cells | Disc, ...], width_m: float, height_m: float
) -> tuple[Cells | Disc, ...]:
    ground = bar(0.0, 0.0, width_m, height_m)
    return (ground, *(replace(shape, ink="white") for shape in ink))


def _label(labels: tuple[str, ...], width_m: float, top_m: float) -> Text:
    sized = [(text, _fitting_size_m(text, width_m)) for text in labels]
    legible = [choice for choice in sized if choice[1] >= _SMALLEST_LABEL_M]
    text, size_m = (legible or sized[-1:])[0]
    return Text(width_m / 2, top_m + 0.75 * LABEL_HEIGHT_M, size_m, text, "middle")


def _fitting_size_m(text: str, width_m: float) -> float:
    return min(_LARGEST_LABEL_M, 0.98 * width_m / text_width_m(text, 1.0))
