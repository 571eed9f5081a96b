"""Pictures of the stages: numbered, with captions, on one page that needs no other file."""

import base64
import re
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.detect import Detector
from tagmetry.detect.stages import Stages, look_through
from tagmetry.errors import InputError
from tagmetry.markers import family
from tagmetry.record.stages import write_stages
from tagmetry.record.stages.closeup import Closeup
from tagmetry.record.stages.panel import Panel, captioned, shown

NAMES = [
    "grey", "half", "levels", "mask", "areas", "outlines", "squares", "cells", "bits", "ids",
    "corners", "residual",
    "seed003-colour", "seed003-grey", "seed003-edges", "seed003-contours",
    "seed001-threshold", "seed001-rectangles", "seed001-straightened", "seed001-code",
    "seed001-corners",
]  # fmt: skip
WITHOUT_A_MARKER = {
    "cells", "bits", "corners", "residual", "seed001-straightened", "seed001-code",
}  # fmt: skip


@pytest.fixture(scope="module")
def stages() -> Stages:
    cells = np.pad(family("tag36h11").picture(7), 2, constant_values=True)
    pixels = np.kron(np.where(cells, 200, 40), np.ones((9, 9))).astype(np.uint8)
    pixels = cv2.GaussianBlur(pixels, (0, 0), 0.8)
    return look_through(cv2.cvtColor(pixels, cv2.COLOR_GRAY2BGR), Detector())


def test_files_are_numbered_in_order_and_can_be_opened(stages: Stages, tmp_path: Path) -> None:
    files = write_stages(stages, tmp_path / "out")
    pictures = [f"{number:02d}-{name}.png" for number, name in enumerate(NAMES, start=1)]
    assert [path.name for path in files] == [*pictures, "index.html"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == sorted(
        p.name for p in files
    )
    for path in files[:-1]:
        pixels = cv2.imread(str(path))
        assert pixels is not None
        assert pixels.shape[1] >= 640


def test_the_page_holds_every_picture_and_asks_for_no_other_file(
    stages: Stages, tmp_path: Path
) -> None:
    page = write_stages(stages, tmp_path)[-1].read_text(encoding="utf-8")
    sources = re.findall(r'src="([^"]*)"', page)
    assert len(sources) == len(NAMES)
    for source in sources:
        kind, _, content = source.partition(",")
        assert kind == "data:image/jpeg;base64"
        pixels = cv2.imdecode(np.frombuffer(base64.b64decode(content), np.uint8), 1)
        assert pixels.ndim == 3
    assert not re.search(r"https?://|<script|<link", page)
    assert "tag36h11 id 7, 0 wrong bits" in page


def test_without_a_marker_only_the_whole_image_is_shown(tmp_path: Path) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (60, 80), dtype=np.uint8)
    files = write_stages(look_through(noise, Detector()), tmp_path)
    names = [path.stem.partition("-")[2] for path in files[:-1]]
    assert names == [name for name in NAMES if name not in WITHOUT_A_MARKER]


def test_a_folder_that_cannot_be_made_is_refused(stages: Stages, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot make the folder"):
        write_stages(stages, tmp_path / "file")


def test_places_of_a_closeup_are_the_middles_of_its_large_pixels() -> None:
    grey = np.random.default_rng(1).integers(0, 256, (30, 40), dtype=np.uint8)
    view = Closeup.around(grey, np.array([5.2, 7.9]), np.array([14.1, 19.5]), 200)
    for x, y in ((5, 7), (9, 12), (15, 20)):
        at = view.at(np.array([x, y], dtype=np.float64))
        column, row = np.floor(at).astype(int)
        assert view.canvas[row, column, 0] == grey[y, x]
        np.testing.assert_allclose(at % view.times, (view.times - 1) / 2)


def test_a_closeup_stays_within_the_image() -> None:
    grey = np.zeros((30, 40), np.uint8)
    view = Closeup.around(grey, np.array([-9.0, 25.0]), np.array([3.0, 99.0]), 100)
    np.testing.assert_array_equal(view.first_px, [0, 25])
    assert view.canvas.shape[:2] == (5 * view.times, 4 * view.times)


def test_a_caption_leaves_the_picture_as_it_is() -> None:
    pixels = shown(np.random.default_rng(2).integers(0, 256, (50, 700), dtype=np.uint8))
    done = captioned(Panel("name", "Title", "Some words that say what is seen here.", pixels), 3)
    np.testing.assert_array_equal(done[:50], pixels)
    band = done[50:]
    assert (band == 255).all(axis=2).any()
    assert len(band) > 20


def test_small_pictures_are_enlarged_by_whole_factors() -> None:
    grey = np.arange(12, dtype=np.uint8).reshape(3, 4) * 20
    large = shown(grey)
    times = large.shape[1] // 4
    assert large.shape == (3 * times, 4 * times, 3)
    np.testing.assert_array_equal(large[times // 2 :: times, times // 2 :: times, 0], grey)
