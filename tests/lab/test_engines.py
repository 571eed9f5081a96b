"""Every engine answers in our convention, for every family that it knows."""

import numpy as np
import pytest

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.lab.bench.case import Case
from tagmetry.lab.bench.matching import matched
from tagmetry.lab.bench.render import rendered
from tagmetry.lab.bench.setup import Setup
from tagmetry.lab.engines import EngineKind, chosen, engine_names, installed
from tagmetry.lab.engines import kinds as kinds_module

FAMILIES = (
    "tag36h11",
    "tagStandard41h12",
    "tagCircle21h7",
    "tag25h9",
    "4x4_50",
    "6x6_250",
    "aruco_mip_36h12",
)
STILL = [kind for kind in installed() if not kind.tracks]
LARGEST_RMS_PX = {"opencv-none": 0.8, "opencv-contour": 0.8, "opencv-subpix": 0.25}
SCENES: dict[str, Case] = {}


def scene(family: str) -> Case:
    """Return six markers of 80 px before plain grey, rendered by the twin."""
    if family not in SCENES:
        setup = Setup("scene", count=6, side_px=80, size_px=(640, 480), cluttered=False)
        SCENES[family] = rendered(setup, family)
    return SCENES[family]


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("kind", STILL, ids=lambda kind: kind.name)
def test_corners_are_where_the_markers_are(kind: EngineKind, family: str) -> None:
    if not kind.knows(family):
        pytest.skip(f"{kind.name} does not know {family}")
    case = scene(family)
    found = kind.make(family, 1).detect(case.images[0])
    pairs = matched(found, case.truths[0])
    assert len(pairs.true) == 6
    off_px = found.corners_px[pairs.found] - case.truths[0].corners_px[pairs.true]
    assert np.sqrt(np.mean(off_px**2)) < LARGEST_RMS_PX.get(kind.name, 0.1)
    assert np.abs(off_px.mean(axis=(0, 1))).max() < 0.1  # nobody's convention is left


@pytest.mark.parametrize("kind", STILL, ids=lambda kind: kind.name)
def test_nothing_found_has_no_corners(kind: EngineKind) -> None:
    grey = np.full((120, 160), 128, np.uint8)
    found = kind.make("tag36h11", 1).detect(grey)
    assert found.ids.shape == (0,)
    assert found.corners_px.shape == (0, 4, 2)


def test_the_tracker_follows_a_film() -> None:
    setup = Setup("film", 4, 60.0, (320, 240), cluttered=False, images=6, is_film=True)
    film = rendered(setup, "tag36h11")
    (kind,) = [kind for kind in installed() if kind.tracks]
    tracker = kind.make("tag36h11", 1)
    for grey, truth in zip(film.images, film.truths, strict=True):
        found = tracker.detect(grey)
        pairs = matched(found, truth)
        assert len(pairs.true) == 4
        off_px = found.corners_px[pairs.found] - truth.corners_px[pairs.true]
        assert np.sqrt(np.mean(off_px**2)) < 0.02


def test_engines_are_chosen_by_name_and_ours_is_always_there() -> None:
    names = [kind.name for kind in chosen(["opencv-subpix"])]
    assert names == ["tagmetry", "opencv-subpix"]


def test_refuses_an_engine_that_there_is_not() -> None:
    with pytest.raises(InputError, match="unknown engine 'aruco9'; there are tagmetry, "):
        chosen(["aruco9"])


def test_an_engine_that_is_not_installed_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kinds_module, "find_spec", lambda _: None)
    with pytest.raises(MissingExtraError, match=r"the engine locus .*tagmetry\[bench\]"):
        chosen(["locus"])
    assert installed() == ()


def test_names_are_different() -> None:
    assert len(set(engine_names())) == len(engine_names())
