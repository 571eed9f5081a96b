"""What the sheets print, the detector finds: every id of every family, in all four rotations."""

from collections.abc import Iterable

import numpy as np
import pytest
from printed_markers import printed, seen

from tagmetry.detect import Detector
from tagmetry.markers import family, family_names

BATCH = 240  # ids that are rendered at once
LARGE = 5000


def check(name: str, ids: list[int], all_quarters: Iterable[int]) -> None:
    one = family(name)
    detector = Detector([one])
    for sheet, corners_px in printed(one, ids):
        for quarters in all_quarters:
            picture, expected = seen(sheet, corners_px, quarters)
            found = {d.id: d for d in detector.detect(picture)}
            assert set(found) == set(expected), f"{name}, {quarters} quarters"
            for marker_id, square_px in expected.items():
                if (name, marker_id) == ("aruco_original", 1023):
                    continue  # the same after half a turn: no detector can tell which way it stands
                # a tenth of a pixel of print raster, the rest the warp's interpolation
                np.testing.assert_allclose(found[marker_id].corners_px, square_px, atol=0.4)


@pytest.mark.parametrize("name", family_names())
@pytest.mark.parametrize("quarters", range(4))
def test_some_ids_of_every_family(name: str, quarters: int) -> None:
    last = len(family(name)) - 1
    check(name, sorted({0, 1, 2, last // 2, last - 1, last}), range(quarters, quarters + 1))


@pytest.mark.slow
@pytest.mark.parametrize("name", family_names())
def test_every_id_of_every_family(name: str) -> None:
    """Of the largest families, each page of ids in one of the four rotations."""
    count = len(family(name))
    for batch, first in enumerate(range(0, count, BATCH)):
        quarters = range(4) if count < LARGE else [batch % 4]
        check(name, list(range(first, min(first + BATCH, count))), quarters)


def test_border_of_two_cells() -> None:
    one = family("tag36h11").with_border(2)
    for sheet, corners_px in printed(one, [0, 100, 586]):
        picture, expected = seen(sheet, corners_px, 1)
        assert {d.id for d in Detector([one]).detect(picture)} == set(expected)
