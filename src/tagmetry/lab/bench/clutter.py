"""What stands behind the markers: texture, papers with patches, and text, as in a workshop.

A detector spends most of its time on what is no marker. The amount is such that OpenCV's detector
takes about as long as on photographs of full shelves.
"""

from collections.abc import Sequence
from functools import lru_cache

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin import Scene, Shot, exposed
from tagmetry.twin.scenes import Still, Thing, textured
from tagmetry.twin.scenes.furniture import clutter
from tagmetry.twin.scenes.grain import grain

_DEPTH_M = 4.0
_FACING = Rotation.from_euler("x", 180, degrees=True)
_GRAIN_PX = 3  # side of the texture's cells in the image
_CONTRAST = 0.16
_PAPERS_PER_MEGAPIXEL = 60
_PAPER_PX = 90.0
_PAGES_PER_MEGAPIXEL = 6
_PAGE_ROWS, _PAGE_COLUMNS = 120, 200
_WORDS = ("calibrate", "marker", "0123456789", "depth of field", "WARNING", "robot", "x = 3.14")


@lru_cache(maxsize=2)
def clutter_light(size_px: tuple[int, int], seed: int) -> FloatImage:
    """Return the light of clutter that fills an image, sharp, shape (height, width)."""
    camera, rng = _camera(size_px), np.random.default_rng(seed)
    pixel_m = _DEPTH_M / camera.focal_px[0]
    size_m = (size_px[0] * pixel_m, size_px[1] * pixel_m)
    megapixels = size_px[0] * size_px[1] / 1e6
    papers = clutter(
        "papers",
        int(_PAPERS_PER_MEGAPIXEL * megapixels),
        (*size_m, 0.02 * _DEPTH_M),
        _PAPER_PX * pixel_m,
        rng,
        _at((0.0, 0.0), 0.97 * _DEPTH_M),
    )
    places_m = rng.uniform(-0.5, 0.5, (int(_PAGES_PER_MEGAPIXEL * megapixels), 2)) * size_m
    pages = [
        textured("page", _page(rng), pixel_m, _at(place_m, (0.95 - 0.001 * n) * _DEPTH_M))
        for n, place_m in enumerate(places_m)
    ]
    scene = Scene((_wall(size_px, pixel_m, rng), papers, *pages))
    return exposed(scene, Shot(camera, Still(RigidTransform.identity())))


def _camera(size_px: tuple[int, int]) -> Camera:
    width_px, height_px = size_px
    middle_px = ((width_px - 1) / 2, (height_px - 1) / 2)
    return Camera(width_px, height_px, (float(width_px), float(width_px)), middle_px)


def _wall(size_px: tuple[int, int], pixel_m: float, rng: np.random.Generator) -> Thing:
    columns, rows = (size // _GRAIN_PX + 3 for size in size_px)
    texture = grain(rows, columns, rng, _CONTRAST)
    return textured("wall", texture, _GRAIN_PX * pixel_m, _at((0.0, 0.0), _DEPTH_M))


def _page(rng: np.random.Generator) -> Array:
    """Return a page of text as cells from 0 dark to 1 light."""
    page = np.full((_PAGE_ROWS, _PAGE_COLUMNS), 255, np.uint8)
    for row in range(14, _PAGE_ROWS, 16):
        line = "  ".join(rng.permutation(_WORDS))
        cv2.putText(page, line, (4, row), cv2.FONT_HERSHEY_SIMPLEX, 0.4, 0, 1, cv2.LINE_AA)
    return np.asarray(page / 255.0)


def _at(place_m: Sequence[float] | Array, depth_m: float) -> Still:
    return Still(RigidTransform.from_components([*place_m, depth_m], _FACING))
