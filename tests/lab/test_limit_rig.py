"""Pictures in which one thing is varied: it has the value asked for, and the truth holds."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.detect import Detector
from tagmetry.geometry import Array
from tagmetry.lab.bench.bound import bound_px
from tagmetry.lab.bench.case import Case
from tagmetry.lab.bench.render import rendered
from tagmetry.lab.bench.setup import Setup
from tagmetry.lab.experiments.detector_limits import cases, measure
from tagmetry.lab.registry import experiment
from tagmetry.lab.rigs import engines_here
from tagmetry.lab.rigs.limit_sweeps import SIZE_PX, SWEEPS, setup_of

PLAIN = Setup("plain", 4, 40.0, (320, 240), cluttered=False, noise=0.0)


def sides_px(case: Case) -> Array:
    corners_px = case.truths[0].corners_px
    return np.linalg.norm(np.roll(corners_px, 1, axis=1) - corners_px, axis=2)


def test_every_value_of_everything_can_be_rendered() -> None:
    for variable, sweep in SWEEPS.items():
        for value in sweep.values:
            setup = setup_of(variable, value)
            assert setup.count >= 1
            area_px2 = SIZE_PX[0] * SIZE_PX[1] / setup.count
            assert 1.25 * np.sqrt(2) * setup.side_px < 1.01 * np.sqrt(area_px2)


def test_one_thing_is_varied_at_a_time() -> None:
    usual = setup_of("blur", 0.6)
    assert replace(setup_of("noise", 2.0), name=usual.name) == usual
    assert setup_of("distance", 2.0).side_px == 32
    assert setup_of("light", 50.0).noise == 0


@pytest.mark.parametrize("tilt_deg", [0.0, 50.0])
def test_markers_lean_as_asked_against_their_lines_of_sight(tilt_deg: float) -> None:
    Ts = rendered(replace(PLAIN, tilt_deg=tilt_deg), "tag36h11").truths[0].Ts_camera_marker
    sights = Ts.translation / np.linalg.norm(Ts.translation, axis=1, keepdims=True)
    cosines = -(Ts.rotation.as_matrix()[:, :, 2] * sights).sum(axis=1)
    np.testing.assert_allclose(np.degrees(np.arccos(np.minimum(cosines, 1))), tilt_deg, atol=1e-5)


def test_contrast_is_as_asked() -> None:
    case = rendered(replace(PLAIN, count=1, side_px=120.0, contrast=0.2), "tag36h11")
    assert int(case.images[0].max()) - int(case.images[0].min()) == pytest.approx(51, abs=1)
    assert case.seen.white - case.seen.black == pytest.approx(51)


def test_a_moving_marker_is_smeared_and_its_truth_is_its_middle() -> None:
    still, moving = (rendered(replace(PLAIN, motion_px=px), "tag36h11") for px in (0.0, 5.0))
    assert np.hypot(*moving.seen.motion_px) == pytest.approx(5)
    slopes = [
        np.square(np.gradient(case.images[0].astype(float))).mean() for case in (still, moving)
    ]
    assert slopes[1] < 0.7 * slopes[0]
    found = Detector(["tag36h11"]).detect(moving.images[0])
    assert [one.id for one in found] == moving.truths[0].ids.tolist()
    for one, corners_px in zip(found, moving.truths[0].corners_px, strict=True):
        np.testing.assert_allclose(one.corners_px, corners_px, atol=0.1)
    assert bound_px(moving) > bound_px(still)


def test_in_the_dark_the_noise_is_that_of_light_and_reading() -> None:
    case = rendered(replace(PLAIN, count=0, white_electrons=400.0), "tag36h11")
    (image,) = case.images
    grey, gain = image.mean(), case.seen.grey_per_electron
    assert gain == pytest.approx(255 * 0.82 / 400)
    expected = np.sqrt(gain * grey + case.seen.noise**2)
    assert image.std() == pytest.approx(expected, rel=0.05)


def test_quick_cases_are_some_of_all() -> None:
    few, many = cases(quick=True), cases(quick=False)
    assert set(few) < set(many)
    assert {case.variable for case in few} == set(SWEEPS)
    assert experiment("detector-limits").cases(True) == few


def test_a_case_has_a_row_of_every_engine() -> None:
    case = replace(cases(quick=True)[0], variable="side", value=64.0, engines=("opencv-none",))
    rows = {row.engine: row for row in measure(case, 3)}
    assert set(rows) == {"tagmetry", "opencv-none"}
    ours, theirs = rows["tagmetry"], rows["opencv-none"]
    assert ours.found == ours.expected == 15
    assert ours.bound_px < ours.corner_rms_px < 0.2 * theirs.corner_rms_px
    assert 3 < ours.distance2 < 16
    assert np.isnan(theirs.distance2)
    assert ours.failure == theirs.failure == ""


def test_a_worker_that_may_start_no_process_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    class Daemon:
        daemon = True

    monkeypatch.setattr(engines_here, "current_process", Daemon)
    engines_here._team.cache_clear()
    case = rendered(replace(PLAIN, count=0), "tag36h11")
    with pytest.raises(ValueError, match="start the cluster's workers with --no-nanny"):
        engines_here.judged(case, ("tagmetry",))
