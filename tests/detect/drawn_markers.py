"""Markers drawn cell by cell, slightly blurred: no camera, no tilt."""

import cv2
import numpy as np

from tagmetry.detect import Detection
from tagmetry.markers import family


def board(*markers: tuple[str, int], cell_px: int = 8) -> np.ndarray:
    """Markers in a row on white paper, drawn cell by cell, slightly blurred."""
    tiles = []
    for name, marker_id in markers:
        cells = np.pad(family(name).picture(marker_id), 2, constant_values=True)
        tile = np.kron(cells, np.ones((cell_px, cell_px))) * 180 + 40
        tiles.append(np.pad(tile, [(0, 120 - len(tile)), (0, 0)], constant_values=220))
    return cv2.GaussianBlur(np.hstack(tiles).astype(np.uint8), (0, 0), 0.7)


def named(found: tuple[Detection, ...]) -> list[tuple[str, int]]:
    return [(d.family, d.id) for d in found]


def wide(*pieces: tuple[int, int, np.ndarray], ground: float = 200.0) -> np.ndarray:
    """An image of a megapixel, which is looked at in stages, with pieces at (x, y)."""
    picture = np.full((900, 1200), ground)
    for x, y, piece in pieces:
        picture[y : y + piece.shape[0], x : x + piece.shape[1]] = piece
    noise = np.random.default_rng(0).normal(0, 2, picture.shape)
    return np.clip(np.rint(picture + noise), 0, 255).astype(np.uint8)


def tile(marker_id: int, cell_px: int, quiet_cells: int = 1) -> np.ndarray:
    cells = np.pad(family("tag36h11").picture(marker_id), quiet_cells, constant_values=True)
    return cv2.GaussianBlur(np.kron(cells, np.ones((cell_px, cell_px))) * 170 + 40, (0, 0), 0.7)
