"""What an engine is: a detector of markers, ours or a peer's, behind one interface.

Every engine answers in the convention of this package: corners clockwise from the marker's own top
left, an integer pixel is a pixel's centre. What differs is converted by the engine itself.
"""

from dataclasses import dataclass
from importlib import import_module
from typing import Protocol

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels, IntArray


@dataclass(frozen=True, eq=False)
class Found:
    """The markers that an engine found in an image.

    Attributes:
        ids: Shape (n,).
        corners_px: Shape (n, 4, 2).
        covariances_px2: Of (x0, y0, x1, ...), shape (n, 8, 8), where the engine states them.
    """

    ids: IntArray
    corners_px: Array
    covariances_px2: Array | None = None

    @classmethod
    def of(cls, ids: object, corners_px: object, covariances_px2: object = None) -> "Found":
        """Return what was found as arrays; nothing found has arrays of length 0."""
        stated = covariances_px2 is not None
        return cls(
            np.asarray(ids, dtype=np.int64).reshape(-1),
            np.asarray(corners_px, dtype=np.float64).reshape(-1, 4, 2),
            np.asarray(covariances_px2, dtype=np.float64).reshape(-1, 8, 8) if stated else None,
        )


class Engine(Protocol):
    """Finds the markers of one family in images, one after another."""

    def detect(self, grey: GreyPixels) -> Found:
        """Return the markers in an image of shape (h, w)."""


@dataclass(frozen=True)
class EngineKind:
    """An engine before it is made.

    Attributes:
        name: What it is called in tables and on the command line.
        maker: `module:function` that makes it, of (family, threads); imported where it runs.
        families: Names of the families that it knows; None for every one that we know.
        author: Who made the detector; agreement counts between authors, not between variants.
        needs: The module that must be installed for it.
        tracks: It follows markers from image to image, and is for moving pictures only.
    """

    name: str
    maker: str
    families: frozenset[str] | None
    author: str
    needs: str = "cv2"
    tracks: bool = False

    def knows(self, family: str) -> bool:
        """Say whether it can look for a family."""
        return self.families is None or family in self.families

    def make(self, family: str, threads: int) -> Engine:
        """Return the engine for a family, which may use so many threads."""
        module, _, function = self.maker.partition(":")
        engine: Engine = getattr(import_module(module), function)(family, threads)
        return engine
