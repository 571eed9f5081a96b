"""A printed page, whatever it is written as: cells of ink and lines of text.

Frame: the origin is the page's top left corner, x to the right, y down, metres.
"""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from tagmetry.geometry.arrays import BoolArray

Ink = Literal["black", "white"]

_WIDE, _CAPITAL, _NARROW, _OTHER = 0.95, 0.73, 0.34, 0.57  # shares of the font's size, Helvetica
_ASCENT, _DESCENT = 0.78, 0.24


@dataclass(frozen=True)
class Box:
    """An upright rectangle."""

    x_m: float
    y_m: float
    width_m: float
    height_m: float

    @property
    def right_m(self) -> float:
        """Where it ends on the right."""
        return self.x_m + self.width_m

    @property
    def bottom_m(self) -> float:
        """Where it ends at the bottom."""
        return self.y_m + self.height_m

    def shrunk(self, by_m: float) -> "Box":
        """Return it with all four sides moved inwards."""
        return Box(
            self.x_m + by_m, self.y_m + by_m, self.width_m - 2 * by_m, self.height_m - 2 * by_m
        )


@dataclass(frozen=True)
class Cells:
    """A box divided evenly into cells, some of them filled.

    Attributes:
        box: Where it is.
        filled: Which cells are filled, (rows, columns), the first row at the top.
        ink: What they are filled with; later shapes cover earlier ones.
    """

    box: Box
    filled: BoolArray
    ink: Ink = "black"

    def moved(self, x_m: float, y_m: float) -> "Cells":
        """Return it moved to the right and down."""
        return replace(self, box=_moved(self.box, x_m, y_m))


@dataclass(frozen=True)
class Disc:
    """A filled circle."""

    x_m: float
    y_m: float
    radius_m: float
    ink: Ink = "black"

    @property
    def box(self) -> Box:
        """The square around it."""
        side_m = 2 * self.radius_m
        return Box(self.x_m - self.radius_m, self.y_m - self.radius_m, side_m, side_m)

    def moved(self, x_m: float, y_m: float) -> "Disc":
        """Return it moved to the right and down."""
        return replace(self, x_m=self.x_m + x_m, y_m=self.y_m + y_m)


@dataclass(frozen=True)
class Text:
    """A line of black text.

    Attributes:
        x_m: Where it starts, or where its middle is.
        baseline_m: Where its letters stand.
        size_m: The font's size, about 1.4 times the height of a capital letter.
        text: What is said.
        anchor: What `x_m` is of the text.
    """

    x_m: float
    baseline_m: float
    size_m: float
    text: str
    anchor: Literal["start", "middle"] = "start"

    @property
    def shown(self) -> str:
        """The text in characters that every font and file has."""
        return plain(self.text)

    @property
    def box(self) -> Box:
        """The room that it takes, rather too wide than too narrow."""
        width_m = text_width_m(self.text, self.size_m)
        left_m = self.x_m if self.anchor == "start" else self.x_m - width_m / 2
        top_m = self.baseline_m - _ASCENT * self.size_m
        return Box(left_m, top_m, width_m, (_ASCENT + _DESCENT) * self.size_m)

    def moved(self, x_m: float, y_m: float) -> "Text":
        """Return it moved to the right and down."""
        return replace(self, x_m=self.x_m + x_m, baseline_m=self.baseline_m + y_m)


Shape = Cells | Disc | Text


@dataclass(frozen=True)
class Page:
    """One side of paper.

    Attributes:
        width_m: Width of the paper.
        height_m: Height of the paper.
        shapes: What is printed, in the order of printing.
        title: What it is, for the file's properties.
    """

    width_m: float
    height_m: float
    shapes: tuple[Shape, ...]
    title: str


def bar(x_m: float, y_m: float, width_m: float, height_m: float, ink: Ink = "black") -> Cells:
    """Return a filled rectangle: a line, a square, a background."""
    return Cells(Box(x_m, y_m, width_m, height_m), np.ones((1, 1), dtype=bool), ink)


def plain(text: str) -> str:
    """Return a text in ASCII, which every font and file has; other characters become `?`."""
    return "".join(letter if " " <= letter <= "~" else "?" for letter in text)


def text_width_m(text: str, size_m: float) -> float:
    """Return an upper bound of a text's width."""
    return size_m * sum(_letter_width(letter) for letter in text)


def _letter_width(letter: str) -> float:
    if letter in "mwMW%@":
        return _WIDE
    if letter in "iljtfrI.,:;|!'()[]/- ":
        return _NARROW
    return _CAPITAL if letter.isupper() else _OTHER


def _moved(box: Box, x_m: float, y_m: float) -> Box:
    return replace(box, x_m=box.x_m + x_m, y_m=box.y_m + y_m)
