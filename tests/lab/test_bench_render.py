"""Rendered cases: what is said to be true is what is seen, and always the same."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.detect import Detector
from tagmetry.detect.photometric.bound import corner_bound_px
from tagmetry.errors import InputError
from tagmetry.lab.bench.bound import bound_px
from tagmetry.lab.bench.case import Case
from tagmetry.lab.bench.hostile import Hostile
from tagmetry.lab.bench.render import rendered
from tagmetry.lab.bench.setup import FULL_HD, Setup
from tagmetry.lab.bench.setups import EXACT, SETUPS
from tagmetry.lab.bench.works import fitting, renderings, steps
from tagmetry.markers import family

SMALL = Setup("small", count=4, size_px=(320, 240), side_px=40.0)


@pytest.fixture(scope="module")
def cluttered() -> Case:
    return rendered(SMALL, "tag36h11")


def test_markers_are_where_the_truth_says(cluttered: Case) -> None:
    found = Detector(["tag36h11"]).detect(cluttered.images[0])
    assert [one.id for one in found] == cluttered.truths[0].ids.tolist()
    for one, corners_px in zip(found, cluttered.truths[0].corners_px, strict=True):
        np.testing.assert_allclose(one.corners_px, corners_px, atol=0.1)


def test_sides_are_about_as_long_as_asked(cluttered: Case) -> None:
    corners_px = cluttered.truths[0].corners_px
    sides = np.linalg.norm(np.roll(corners_px, 1, axis=1) - corners_px, axis=2)
    assert 0.75 * 40 < sides.mean() < 1.1 * 40


def test_always_the_same(cluttered: Case) -> None:
    again = rendered(SMALL, "tag36h11")
    np.testing.assert_array_equal(again.images[0], cluttered.images[0])


def test_noise_is_as_asked() -> None:
    plain = replace(SMALL, count=0, cluttered=False, noise=5.0)
    (image,) = rendered(plain, "tag36h11").images
    assert image.std() == pytest.approx(5.0, rel=0.05)


def test_clutter_has_structure_and_plain_has_none() -> None:
    quiet = replace(SMALL, count=0, noise=0.0)
    assert rendered(quiet, "tag36h11").images[0].std() > 20
    assert rendered(replace(quiet, cluttered=False), "tag36h11").images[0].std() < 1


def test_levels_are_those_of_the_camera() -> None:
    large = Setup("l", 1, 150.0, (320, 240), cluttered=False, noise=0.0, exponent=2.2)
    case = rendered(large, "tag36h11")
    assert case.images[0].min() == pytest.approx(case.seen.black, abs=1)
    assert case.images[0].max() == pytest.approx(case.seen.white, abs=1)


def test_a_film_goes_round_without_a_jump() -> None:
    film = rendered(replace(SMALL, cluttered=False, images=6, is_film=True), "tag36h11")
    middles = np.array([truth.corners_px.mean(axis=1) for truth in film.truths])
    steps_px = np.linalg.norm(np.roll(middles, -1, axis=0) - middles, axis=2)
    assert film.moves
    assert steps_px.min() > 3
    assert steps_px.max() < 10


def test_several_images_are_several_scenes() -> None:
    case = rendered(replace(SMALL, cluttered=False, images=2), "tag36h11")
    assert case.once
    assert not case.moves
    assert [truth.ids.tolist() for truth in case.truths] == [[0, 1, 2, 3], [4, 5, 6, 7]]
    first, second = (truth.corners_px for truth in case.truths)
    np.testing.assert_allclose(first.mean(axis=1), second.mean(axis=1), atol=3)
    assert np.abs(first - second).max() > 3


def test_corners_are_judged_on_all_sizes_noises_and_responses() -> None:
    """Decibels are those of the contrast, in the camera's own grey values."""
    assert len({(one.side_px, one.exponent, round(one.noise, 3)) for one in EXACT}) == 12
    for setup in EXACT:
        case = rendered(replace(setup, count=0, images=1, cluttered=False), "tag36h11")
        contrast = case.seen.white - case.seen.black
        decibels = 20 * np.log10(contrast / case.images[0].std())
        assert f"-{setup.side_px:g}-" in setup.name
        assert decibels == pytest.approx(20 if "-20dB" in setup.name else 40, abs=0.3)
        assert (setup.exponent == 2.2) == setup.name.endswith("-gamma")


def test_hostile_images_show_no_marker() -> None:
    case = Hostile("tag36h11").case()
    assert {image.shape for image in case.images} == {(1080, 1920)}
    assert {image.dtype for image in case.images} == {np.dtype(np.uint8)}
    assert [len(truth.ids) for truth in case.truths] == [0] * len(case.images)
    assert Detector(["tag36h11"]).detect(case.images[3]) == ()


def test_the_bound_is_that_of_the_markers() -> None:
    case = rendered(replace(SMALL, count=1, cluttered=False), "tag36h11")
    printed = case.seen.printed(family("tag36h11").picture(0), 0)
    noise = np.hypot(SMALL.noise, 1 / np.sqrt(12))
    expected_px = corner_bound_px(case.truths[0].corners_px[0], printed, noise)
    assert bound_px(case) == pytest.approx(expected_px)


def test_without_markers_there_is_no_bound() -> None:
    assert bound_px(rendered(replace(SMALL, count=0, cluttered=False), "tag36h11")) is None


@pytest.mark.parametrize("setup", SETUPS, ids=lambda setup: setup.name)
def test_markers_of_every_case_have_room(setup: Setup) -> None:
    area_px2 = setup.size_px[0] * setup.size_px[1] / max(1, setup.count)
    widest_px = setup.side_px * 1.25 * np.sqrt(2)
    assert widest_px < 0.99 * np.sqrt(area_px2)
    assert setup.size_px == FULL_HD or setup.name.startswith("size-")


def test_extents_grow() -> None:
    names = [
        {w.name for w in renderings(extent, "tag36h11")} for extent in ("quick", "default", "full")
    ]
    assert names[0] < names[1] < names[2]
    assert names[2] == {setup.name for setup in SETUPS} | {"hostile"}


def test_cases_are_chosen_by_pattern() -> None:
    works = renderings("full", "tag36h11")
    assert [w.name for w in fitting(works, ["noise-1*", "none"])] == ["none", "noise-16"]


def test_refuses_a_case_that_there_is_not() -> None:
    with pytest.raises(InputError, match="no case is called 'sideways'; there are count-24, "):
        fitting(renderings("full", "tag36h11"), ["sideways"])


def test_refuses_a_family_that_there_is_not() -> None:
    with pytest.raises(InputError, match="unknown marker family"):
        renderings("quick", "tag99")


def test_all_cases_run_with_one_thread_and_some_with_more() -> None:
    works = renderings("quick", "tag36h11")
    planned = steps(works, [1, 4])
    assert [step.threads for step in planned] == [1] * len(works) + [4] * 2
    assert {step.work.name for step in planned if step.threads == 4} == {"count-24", "film-24"}
