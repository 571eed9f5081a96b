"""Near the frontal view more images are averaged, until the turn is sure or the marker moves."""

import numpy as np
import pytest
from webcam_rig import moving, still, task

from tagmetry.lens.measured import turn_about_y_deg
from tagmetry.pipeline.lens import measure_marker


def test_a_frontal_marker_is_averaged_and_an_oblique_one_is_not() -> None:
    frontal = list(measure_marker(still(0.55, 0.0, seed=3), task()))
    averaged = [step for step in frontal if step.phase == "average"]
    assert [step.found.images for step in averaged] == list(range(3, 9))
    assert all(step.is_final for step in averaged)
    turns = [step.found.turn_sd_rad for step in frontal if step.is_final]
    assert turns[-1] < 0.9 * turns[0]
    assert abs(turn_about_y_deg(averaged[-1].found.T_camera_marker)) < 1.0
    oblique = list(measure_marker(still(0.55, 40.0), task()))
    assert oblique[-1].found.images == 2
    assert np.degrees(oblique[-1].found.turn_sd_rad) < 0.3


def test_a_marker_that_moves_on_keeps_the_mean_from_before() -> None:
    camera = moving([0.0, 0.36, 0.5], [0.55, 0.55, 0.55], [0.0, 0.0, 0.03])
    *_, last = measure_marker(camera, task(wanted_turn_rad=1e-9, most_averaged=50))
    assert last.is_final
    assert "the marker moves; this is the mean of" in last.reason
    assert 2 <= last.found.images < 50
    assert last.found.depth_m == pytest.approx(0.55, rel=3e-3)
    assert abs(last.found.T_camera_marker.translation[0]) < 1e-3
