"""The benchmark measures what it says, on a small picture."""

import numpy as np

from tagmetry.lab.bench import bench, case


def test_every_contender_finds_the_markers_and_is_timed() -> None:
    small = case("small", (320, 240), 2, 60, np.random.default_rng(0))
    rows = bench([small], threads=1, repeats=2)
    assert {row.found for row in rows} == {2}
    assert {row.expected for row in rows} == {2}
    assert all(0 < row.median_ms <= row.worst_ms for row in rows)


def test_ratios_are_to_our_own_detector() -> None:
    empty = case("empty", (320, 240), 0, 60, np.random.default_rng(0))
    rows = {row.contender: row for row in bench([empty], threads=1, repeats=3)}
    own = rows["tagmetry detect"]
    assert own.ratio == 1.0
    opencv = rows["OpenCV aruco, subpixel"]
    assert np.isclose(opencv.ratio, opencv.median_ms / own.median_ms)


def test_threads_are_put_back() -> None:
    import cv2

    before = cv2.getNumThreads()
    bench([], threads=1, repeats=1)
    assert cv2.getNumThreads() == before
