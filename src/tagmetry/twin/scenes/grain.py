"""Textures as cells from 0 dark to 1 light."""

import cv2
import numpy as np

from tagmetry.geometry import Array

_OCTAVES = 5


def checker(rows: int, columns: int) -> Array:
    """Return squares of one cell in turn, shape (rows, columns); the top left one is dark."""
    return np.add.outer(np.arange(rows), np.arange(columns)) % 2.0


def grain(rows: int, columns: int, rng: np.random.Generator, contrast: float = 0.25) -> Array:
    """Return noise that is alike at several scales, as of plaster, concrete or carpet.

    Args:
        rows: Of cells.
        columns: Of cells.
        rng: Where it comes from.
        contrast: Its standard deviation; it is round 0.5, and cut off at 0 and 1.
    """
    total = np.zeros((rows, columns))
    for octave in range(_OCTAVES):
        coarse = (max(columns >> octave, 2), max(rows >> octave, 2))
        noise = rng.standard_normal(coarse[::-1])
        total += cv2.resize(noise, (columns, rows), interpolation=cv2.INTER_CUBIC)
    return np.asarray(np.clip(0.5 + contrast * total / np.sqrt(_OCTAVES), 0.0, 1.0))
