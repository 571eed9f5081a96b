"""The whole way on the twin's webcam: found, converged, followed, found again."""

import numpy as np
import pytest
from webcam_rig import moving, still, task

from tagmetry.errors import InputError
from tagmetry.lens import Lag, seed_scan
from tagmetry.lens.measured import turn_about_y_deg
from tagmetry.pipeline.lens import measure_marker, measure_markers
from tagmetry.twin.camera import (
    BeforeCamera,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Still


@pytest.mark.parametrize(("depth_m", "turn_deg"), [(0.06, 30), (0.3, 10), (1.0, 40)])
def test_a_marker_is_found_and_measured(depth_m: float, turn_deg: float) -> None:
    steps = list(measure_marker(still(depth_m, turn_deg), task()))
    last = steps[-1]
    assert last.is_final
    assert sum(step.phase == "scan" for step in steps) <= 11
    assert last.image.time_s - steps[0].image.time_s < 0.85
    assert last.found.depth_m == pytest.approx(depth_m, rel=3e-3)
    assert abs(last.found.depth_m - depth_m) < 4 * last.found.depth_sd_m
    assert abs(turn_about_y_deg(last.found.T_camera_marker)) == pytest.approx(turn_deg, abs=0.5)


def test_a_marker_that_takes_nearly_all_the_zoom_converges() -> None:
    *_, last = measure_marker(still(1.05, 63.0), task(most_images=30))
    assert last.is_final
    assert last.found.depth_m == pytest.approx(1.05, rel=3e-3)


def test_the_camera_is_left_as_it_was_found() -> None:
    camera = still(0.2)
    before = {name: camera.controls.read(name) for name in camera.controls.available}
    steps = measure_marker(camera, task())
    next(steps)
    assert camera.controls.read("auto_focus") == 0
    steps.close()  # as an interrupt does
    assert {name: camera.controls.read(name) for name in camera.controls.available} == before


@pytest.mark.slow
@pytest.mark.parametrize(("from_m", "to_m"), [(0.05, 1.05), (1.05, 0.05)])
def test_a_marker_that_moves_along_the_axis_is_followed(from_m: float, to_m: float) -> None:
    camera = moving([0, 0.7, 5.7], [from_m, from_m, to_m], [0, 0, 0])
    tracked = []
    for step in measure_marker(camera, task(), tracks=True):
        tracked += [step] if step.image.time_s > 0.7 else []
        if step.image.time_s > 5.7:
            break
    assert len(tracked) > 140
    assert all(step.found is not None for step in tracked)
    passed = np.array([min((step.image.time_s - 0.7) / 5.0, 1.0) for step in tracked])
    found_m = np.array([step.found.depth_m for step in tracked])
    assert np.abs(found_m / (from_m + (to_m - from_m) * passed) - 1).max() < 3e-3
    assert max(step.found.blur_px for step in tracked) < 4


@pytest.mark.slow
def test_a_marker_that_leaves_and_returns_is_found_again_soon() -> None:
    camera = moving(
        [0, 0.59, 0.6, 1.0, 1.01, 2.0], [0.2, 0.2, 0.2, 0.45, 0.45, 0.45], [0, 0, 5, 5, 0, 0]
    )
    steps = []
    for step in measure_marker(camera, task(), tracks=True):
        steps.append(step)
        if step.phase == "track" and step.image.time_s > 1.0:
            break
    again = next(s for s in steps if s.phase == "reacquire" and s.found is not None)
    assert 1.0 <= again.image.time_s <= 1.4
    assert any(s.phase == "reacquire" and s.reason == "no marker" for s in steps)


def test_nothing_to_be_found_ends_with_the_reason() -> None:
    *_, last = measure_marker(still(3.0), task(most_images=12))
    assert last.found is None
    assert "no marker in 12 images" in last.reason


@pytest.mark.slow
def test_several_markers_are_measured_one_after_the_other() -> None:
    places = {7: (0.1, -0.01), 9: (0.6, 0.05)}
    scene = markers_before_camera(
        *(
            BeforeCamera(Still(facing_camera(z_m, 25.0, x_m)), marker_id)
            for marker_id, (z_m, x_m) in places.items()
        )
    )
    steps = measure_markers(TwinCamera(scene, webcam(), quick=True), task(), (7, 9))
    final = {step.found.detection.id: step.found for step in steps if step.is_final}
    assert {i: round(found.depth_m, 2) for i, found in final.items()} == {7: 0.1, 9: 0.6}


def test_the_paper_s_scan_finds_it_in_eleven_images() -> None:
    plan = seed_scan(task().lens)
    steps = list(measure_marker(still(0.8), task(), plan=plan, lag=Lag(1, 33.0)))
    assert steps[-1].is_final


def test_tasks_that_make_no_sense_are_refused() -> None:
    with pytest.raises(InputError, match="wanted_share"):
        task(wanted_share=0.0)
    with pytest.raises(InputError, match="most_images"):
        task(most_images=0)
