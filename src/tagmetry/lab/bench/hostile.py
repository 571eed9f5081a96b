"""Full HD images made to keep a detector busy; none shows a marker."""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.bench.case import Case, nothing
from tagmetry.lab.bench.setup import FULL_HD

_DARK, _LIGHT = 30, 220
_CHECKS_PX = (6, 16, 48)
_FRAMES_PX = (32, 48)
_TEXT = "il1o0 8B&# marker [#] " * 12
_LINE_PX = 14


@dataclass(frozen=True)
class Hostile:
    """Checks, text, noise, and hundreds of pictures in frames.

    Attributes:
        family: What to look for in vain.
        name: What the case is called.
        all_threads: It is measured with all threads as well.
    """

    family: str
    name: str = "hostile"
    all_threads: bool = False

    def case(self) -> Case:
        """Return the case with its images, always the same ones."""
        rng = np.random.default_rng(0)
        images = [
            *(_checks(cell_px) for cell_px in _CHECKS_PX),
            *(_framed(side_px, rng) for side_px in _FRAMES_PX),
            _text(),
            _blocks(rng),
            np.asarray(rng.integers(0, 256, FULL_HD[::-1]), np.uint8),
        ]
        return Case(self.name, self.family, tuple(images), nothing(len(images)))


def _checks(cell_px: int) -> GreyPixels:
    """Return a checkerboard."""
    y, x = np.mgrid[: FULL_HD[1], : FULL_HD[0]] // cell_px
    return np.asarray(np.where((x + y) % 2 == 0, _DARK, _LIGHT), np.uint8)


def _framed(side_px: int, rng: np.random.Generator) -> GreyPixels:
    """Return dark frames in rows with random cells in them, as of a dictionary nobody has."""
    cell_px = side_px // 8
    pitch = 10  # cells, of which two are paper
    columns, rows = (size // (pitch * cell_px) for size in FULL_HD)
    cells = np.ones((rows, pitch, columns, pitch), bool)
    cells[:, 1:9, :, 1:9] = False
    cells[:, 2:8, :, 2:8] = rng.integers(0, 2, (rows, 6, columns, 6))
    return _filled(cells.reshape(rows * pitch, columns * pitch), cell_px)


def _text() -> GreyPixels:
    """Return a page of small print."""
    page = np.full(FULL_HD[::-1], _LIGHT, np.uint8)
    for row in range(_LINE_PX, FULL_HD[1], _LINE_PX):
        cv2.putText(page, _TEXT, (4, row), cv2.FONT_HERSHEY_SIMPLEX, 0.4, _DARK, 1, cv2.LINE_AA)
    return page


def _blocks(rng: np.random.Generator) -> GreyPixels:
    """Return squares of 18 pixels, dark and light at random."""
    return _filled(rng.integers(0, 2, (60, 106)).astype(bool), 18)


def _filled(cells: np.ndarray, cell_px: int) -> GreyPixels:
    """Return cells as an image; what they leave free is light."""
    page = np.full(FULL_HD[::-1], _LIGHT, np.uint8)
    drawn = np.where(cells, _LIGHT, _DARK).repeat(cell_px, axis=0).repeat(cell_px, axis=1)
    page[: drawn.shape[0], : drawn.shape[1]] = drawn
    return page
