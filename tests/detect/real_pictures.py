"""The data folder's pictures, its lists of corners, and how far detections are from them."""

import os
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.detect import Detection
from tagmetry.geometry import Array

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))


def pictures(folder: str, pattern: str = "*") -> list[Path]:
    """Return a set's pictures in order; skips the test where the set is missing."""
    found = sorted(p for p in (DATA / folder).glob(pattern) if p.suffix.lower() in {".jpg", ".png"})
    if not found:
        pytest.skip(f"no pictures of {folder} in {DATA}; TAGMETRY_DATA names the folder")
    return found


def grey(path: Path) -> np.ndarray:
    """Return a picture in grey."""
    return cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)


def images(video: str, every: int, count: int) -> Iterator[np.ndarray]:
    """Return `count` BGR images of a video, one of `every`; skips where the video is missing."""
    av = pytest.importorskip("av")
    if not (DATA / video).exists():
        pytest.skip(f"no {video} in {DATA}; TAGMETRY_DATA names the folder")
    with av.open(str(DATA / video)) as container:
        for i, frame in enumerate(container.decode(video=0)):
            if i >= every * count:
                return
            if i % every == 0:
                yield frame.to_ndarray(format="bgr24")


def apriltag_corners(path: Path) -> list[Array]:
    """Return squares (4, 2) of an AprilTag library's list, in our order and pixels.

    Its corners go counter-clockwise, and its pixel centres lie at +0.5.
    """
    lines = path.read_text().translate(str.maketrans(",()", "   ")).splitlines()
    rows = [line.split() for line in lines]
    return [np.array(row[1:], dtype=float).reshape(4, 2)[::-1] - 0.5 for row in rows if row]


def listed_corners(path: Path) -> dict[int, Array]:
    """Return squares (4, 2) by id of a list: a line with the id, then four with a corner each."""
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    return {int(rows[i][0]): np.array(rows[i + 1 : i + 5], float) for i in range(0, len(rows), 5)}


def kalibr_corners(path: Path) -> dict[int, dict[int, Array]]:
    """Return corners (2,) by id and by our index, from a CSV of an AprilGrid.

    Kalibr counts a tag's corners counter-clockwise from its bottom left.
    """
    rows = np.loadtxt(path, delimiter=",", comments="#", ndmin=2)
    tags: dict[int, dict[int, Array]] = {}
    for row in rows:
        tags.setdefault(int(row[10]), {})[3 - int(row[11])] = row[5:7]
    return tags


def at(found: tuple[Detection, ...], square_px: Array) -> Detection | None:
    """Return the detection around a square's centre."""
    near = [d for d in found if np.linalg.norm((d.corners_px - square_px).mean(axis=0)) < 3]
    return min(near, key=lambda d: distances(d, square_px).max(), default=None)


def distances(found: Detection, square_px: Array) -> Array:
    """Return each corner's distance, the square starting at whichever corner fits best."""
    turned = [np.roll(square_px, k, axis=0) for k in range(4)]
    all_px = [np.linalg.norm(found.corners_px - square, axis=1) for square in turned]
    return min(all_px, key=np.sum)


def ids(found: tuple[Detection, ...]) -> list[int]:
    """Return the ids, duplicates kept."""
    return [detection.id for detection in found]
