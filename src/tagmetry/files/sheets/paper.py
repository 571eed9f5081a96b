"""Paper sizes and how a page is set up."""

import math
import re
from dataclasses import dataclass
from typing import Literal

from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm, parse_length_m

Orientation = Literal["auto", "portrait", "landscape"]

_ORIENTATIONS: dict[str, Orientation] = {
    "auto": "auto",
    "portrait": "portrait",
    "landscape": "landscape",
}
_INCH_M = 0.0254
_SIZES_M = {
    "a0": (0.841, 1.189),
    "a1": (0.594, 0.841),
    "a2": (0.420, 0.594),
    "a3": (0.297, 0.420),
    "a4": (0.210, 0.297),
    "a5": (0.148, 0.210),
    "a6": (0.105, 0.148),
    "letter": (8.5 * _INCH_M, 11 * _INCH_M),
    "legal": (8.5 * _INCH_M, 14 * _INCH_M),
    "tabloid": (11 * _INCH_M, 17 * _INCH_M),
}
_CUSTOM = re.compile(r"(?P<width>[\d.]+)\s*x\s*(?P<height>[\d.]+)\s*(?P<unit>mm|cm|m|in)")
_LONGEST_M = 5.08  # what a PDF can hold: 14,400 points


@dataclass(frozen=True)
class Paper:
    """A size of paper.

    Attributes:
        name: What it is called.
        width_m: Its width as it is fed.
        height_m: Its height as it is fed.
    """

    name: str
    width_m: float
    height_m: float

    def turned(self, orientation: Orientation) -> tuple["Paper", ...]:
        """Return it in the wanted orientation, or in both for `auto`."""
        short_m, long_m = sorted((self.width_m, self.height_m))
        portrait = Paper(f"{self.name} portrait", short_m, long_m)
        landscape = Paper(f"{self.name} landscape", long_m, short_m)
        either = {"portrait": (portrait,), "landscape": (landscape,)}
        return either.get(orientation, (portrait, landscape))


@dataclass(frozen=True)
class PageSetup:
    """How pages are to look.

    Attributes:
        paper: Its size.
        orientation: `auto` takes the one that needs fewer pages, portrait when equal.
        margin_m: White along the paper's edges, which printers cannot reach.
        quiet_cells: How many cells wide the white around a marker is, at least 1.
        inverted: Print white on black.
    """

    paper: Paper = Paper("a4", *_SIZES_M["a4"])
    orientation: Orientation = "auto"
    margin_m: float = 0.010
    quiet_cells: int = 1
    inverted: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.margin_m) and self.margin_m >= 0):
            raise InputError(f"the margin must be 0 or more, got {self.margin_m} m")
        if self.quiet_cells < 1:
            raise InputError(
                f"a marker needs a quiet zone of at least 1 cell, got {self.quiet_cells}"
            )


def paper_names() -> tuple[str, ...]:
    """Return the names of the papers that are known."""
    return tuple(_SIZES_M)


def parse_paper(text: str) -> Paper:
    """Return a paper by its name, or by its size as in `210x297mm`.

    Raises:
        InputError: There is no such paper; the text lists those there are.
    """
    name = text.strip().lower()
    if name in _SIZES_M:
        return Paper(name, *_SIZES_M[name])
    match = _CUSTOM.fullmatch(name)
    if match is None:
        raise InputError(
            f"unknown paper {text[:40]!r}; there are {', '.join(_SIZES_M)}, "
            "and any size like 210x297mm"
        )
    width_m, height_m = (
        parse_length_m(match[side] + match["unit"]) for side in ("width", "height")
    )
    if max(width_m, height_m) > _LONGEST_M:
        raise InputError(
            f"paper may be up to {format_mm(_LONGEST_M)} long, got {format_mm(width_m)} x "
            f"{format_mm(height_m)}"
        )
    return Paper(name, width_m, height_m)


def parse_orientation(text: str) -> Orientation:
    """Return an orientation by its name.

    Raises:
        InputError: There is no such orientation; the text lists those there are.
    """
    name = text.strip().lower()
    if name not in _ORIENTATIONS:
        known = ", ".join(_ORIENTATIONS)
        raise InputError(f"orientation must be one of {known}, got {text[:40]!r}")
    return _ORIENTATIONS[name]
