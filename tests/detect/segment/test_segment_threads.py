"""What several threads find together is what one finds alone."""

from collections.abc import Iterator

import cv2
import numpy as np
import pytest

from tagmetry.detect.segment import squares, squares_at_a_glance


@pytest.fixture
def opencv_threads() -> Iterator[None]:
    before = cv2.getNumThreads()
    yield
    cv2.setNumThreads(before)


@pytest.mark.usefixtures("opencv_threads")
def test_scales_looked_at_by_several_threads_show_the_same() -> None:
    rng = np.random.default_rng(6)
    blocks = np.kron(rng.integers(0, 2, (60, 100)), np.ones((14, 14))) * 180 + 30
    grey = cv2.GaussianBlur(blocks.astype(np.uint8), (0, 0), 1.0)
    found = []
    for threads in (1, 2):
        cv2.setNumThreads(threads)
        glance = squares_at_a_glance(grey, 9.0, bright=True)
        found.append((squares(grey, 9.0, bright=False).corners_px, glance.corners_px))
    assert len(found[0][0]) > 100
    for alone, together in zip(*found, strict=True):
        np.testing.assert_array_equal(alone, together)
