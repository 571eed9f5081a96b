"""What the page is told of a moment: obstacles, ellipses, markers."""

import numpy as np
import pytest

from tagmetry.arena import STATE_NAMES
from tagmetry.live.show.stage import performance, steerable
from tagmetry.live.show.told import ellipse_of, told_markers
from tagmetry.live.show.told_stage import told_stage
from tagmetry.pipeline.arena_twin.ready import ready_scenario


def test_the_page_is_told_of_virtual_obstacles_and_of_the_fence() -> None:
    stages = {}
    for name in ("wander", "disperse"):
        show = performance(name, ready_scenario(name, 2), None)
        stages[name] = told_stage(show)
        show.close()
    assert stages["wander"].discs == ((-0.75, 0.2, 0.16), (0.8, -0.3, 0.2))
    assert (0.15, 0.85, 0.15, 0.2) in stages["wander"].walls
    assert stages["wander"].reach_m == 1.0
    assert stages["wander"].fence_m == ()
    assert stages["disperse"].fence_m[0] == (-1.6, -0.85)


@pytest.mark.parametrize("turn_rad", [-1.2, 0.0, 0.4, 1.5])
def test_the_ellipse_is_the_covariance(turn_rad: float) -> None:
    c, s = np.cos(turn_rad), np.sin(turn_rad)
    R = np.array([[c, -s], [s, c]])
    long_m, short_m, found_rad = ellipse_of(R @ np.diag([9e-6, 1e-6]) @ R.T)
    np.testing.assert_allclose([long_m, short_m], [3e-3, 1e-3])
    assert abs(np.sin(found_rad - turn_rad)) < 1e-9


def test_an_unknown_covariance_has_no_ellipse() -> None:
    assert np.isnan(ellipse_of(np.full((2, 2), np.nan))[0])
    assert len(STATE_NAMES) == 5


def test_markers_point_where_the_robots_head() -> None:
    scenario, steered = steerable(ready_scenario("aggregate", 5))
    assert set(steered) == set(scenario.by_id)
    show = performance("aggregate", ready_scenario("aggregate", 5), None)
    (*_, moment) = show.arena.run(0.1)
    markers = told_markers(moment.detections, show.roster, 0.5)
    assert len(markers) == 5
    for one in markers:
        state = moment.turn.step.world.robot(one.robot_id)
        middle = np.mean(one.corners_px, axis=0)
        assert state is not None
        ahead = np.array([np.cos(state.heading_rad), np.sin(state.heading_rad), 0.0])
        p_world = np.array([state.x_m, state.y_m, 0.1]) + np.outer([0.0, 0.12], ahead)
        pixels, _ = scenario.view.project(p_world)
        want = pixels[1] - pixels[0]
        got = np.array(one.front_px) - middle
        assert want @ got / np.linalg.norm(want) / np.linalg.norm(got) > 0.99
    show.close()
