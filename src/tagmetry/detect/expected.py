"""What is printed where a marker was found, as far as it can be known.

Around a black square there is white paper. Markers with bits around their border need none, and may
stand on any ground: of these, the last whole ring of cells is the farthest that is looked at.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from tagmetry.detect.named import Named
from tagmetry.detect.photometric import Picture
from tagmetry.detect.reading.decode import free_colours
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import MarkerFamily

_REMEMBERED = 4096  # markers


def expected_pictures(
    grey: GreyPixels, named: Named, families: Sequence[MarkerFamily]
) -> list[Picture]:
    """Return the pictures of markers.

    Args:
        grey: 8-bit image, which tells what stands in cells that are free.
        named: Which markers, and where.
        families: Of the detector.
    """
    each = zip(named.families.tolist(), named.ids.tolist(), named.corners_px, strict=True)
    return [expected_picture(grey, at_px, families[place], own) for place, own, at_px in each]


def expected_picture(
    grey: GreyPixels, corners_px: Array, family: MarkerFamily, marker_id: int
) -> Picture:
    """Return the picture of a marker.

    Args:
        grey: 8-bit image, which tells what stands in cells that are free.
        corners_px: Clockwise from the marker's own top left, shape (4, 2).
        family: Its family.
        marker_id: Its id.
    """
    layout = family.layout
    if not layout.white_border:
        return _on_paper(family, marker_id)
    cells = family.picture(marker_id)
    columns, rows = layout.free_cells.T + layout.margin_cells
    cells[rows, columns] = free_colours(grey, corners_px, layout)
    margin_cells = layout.whole_rings + 1
    beyond = np.pad(cells, 1, constant_values=True)
    cut = layout.margin_cells + 1 - margin_cells
    kept = beyond[cut : len(beyond) - cut, cut : len(beyond) - cut]
    return Picture(kept, margin_cells, quiet_zone=False)


@lru_cache(_REMEMBERED)
def _on_paper(family: MarkerFamily, marker_id: int) -> Picture:
    """Return the picture of a marker with white paper around it."""
    return Picture(family.picture(marker_id), family.layout.margin_cells)
