"""Ready-made scenes: each shows its markers, whatever its parameters are."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import Camera, scaled
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.markers import family
from tagmetry.twin.recipe import Recipe, picture
from tagmetry.twin.scenes import Held, looking
from tagmetry.twin.scenes.ready import READY, backlit_window, ready_recipe, wall
from tagmetry.twin.scenes.ready.choose import parameters_of, sentence
from tagmetry.twin.scenes.ready.circling import Circling
from tagmetry.twin.truth import image_truth

LEAST_SHOWN = {
    "floor": 14, "wall": 8, "arena": 16, "corridor": 6, "room": 3, "board-sweep": 0,
    "backlit-window": 4,
}  # fmt: skip


def shown(recipe: Recipe, number: int = 0) -> list[int]:
    """Return the ids of the markers that a picture shows whole."""
    truth = image_truth(recipe.scene, recipe.shot_of(number))
    return [one.id for one in truth.markers if one.visible_fraction > 0.99]


@pytest.mark.parametrize("name", READY)
def test_every_scene_shows_its_markers(name: str) -> None:
    recipe = ready_recipe(name)
    for number in {0, recipe.count // 2}:
        assert len(shown(recipe, number)) >= LEAST_SHOWN[name], number


@pytest.mark.parametrize("name", READY)
def test_every_scene_says_what_it_is_and_can_be_changed(name: str) -> None:
    assert len(sentence(name)) < 100
    assert sentence(name).endswith(".")
    assert {"images", "seed"} <= set(parameters_of(name))
    assert ready_recipe(name, {"images": 2}).count == 2


def test_a_sweeps_boards_are_whole_and_spread_over_the_picture() -> None:
    recipe = ready_recipe("board-sweep")
    every = [image_truth(recipe.scene, recipe.shot_of(i)).boards[0] for i in range(recipe.count)]
    corners_px = np.stack([one.corners_px for one in every])
    assert corners_px.shape == (35, 54, 2)
    assert recipe.shot.camera.contains(corners_px).all()
    reached = np.ptp(corners_px.reshape(-1, 2), axis=0) / recipe.shot.camera.size_px
    assert (reached > 0.8).all()
    tilts_deg = [_tilt_deg(one.T_camera_board.rotation.as_matrix()) for one in every]
    assert 20 < max(tilts_deg) < 41
    widths_px = np.ptp(corners_px[..., 0], axis=1)
    assert widths_px.max() > 1.8 * widths_px.min()


def _tilt_deg(R_camera_board: Array) -> float:
    return float(np.degrees(np.arccos(-R_camera_board[2, 2])))


@pytest.mark.parametrize("board", ["charuco:7x5:30mm:22mm:5x5_100", "aprilgrid:6x6:30mm:0.3"])
def test_a_sweep_takes_any_board(board: str) -> None:
    recipe = ready_recipe("board-sweep", {"board": board, "images": 3})
    (one,) = image_truth(recipe.scene, recipe.shot_of(2)).boards
    assert recipe.shot.camera.contains(one.corners_px).all()


@pytest.mark.slow
def test_a_walls_markers_are_found_at_the_truth() -> None:
    recipe = wall(columns=2, rows=1, distance_m=0.9)
    shot = replace(recipe.shot, camera=scaled(recipe.shot.camera, 640, 360))  # quick to render
    made = picture(replace(recipe, shot=shot), 0)
    found = {one.id: one for one in Detector([family("tag36h11")]).detect(made.pixels)}
    assert set(found) == {one.id for one in made.truth.markers} == {0, 1}
    for one in made.truth.markers:
        error_px = np.linalg.norm(found[one.id].corners_px - one.corners_px, axis=1)
        assert error_px.max() < 0.05


@pytest.mark.slow
def test_a_webcam_loses_what_an_hdr_camera_sees_beside_a_window() -> None:
    def contrast(hdr: bool) -> float:
        made = picture(backlit_window(hdr=hdr), 0)
        corners = made.truth.markers[0].corners_px
        low, high = corners.min(axis=0).astype(int) - 3, corners.max(axis=0).astype(int) + 4
        return float(np.ptp(made.pixels[low[1] : high[1], low[0] : high[0]]))

    assert contrast(hdr=False) < 30
    assert contrast(hdr=True) > 45


def test_robots_go_round_with_their_front_ahead_and_never_meet() -> None:
    way = Circling((1.0, 2.0, 0.0), 0.3, -0.8, 0.4)
    step_s = 1e-4
    before, here, after = way.at(np.array([1 - step_s, 1.0, 1 + step_s]))
    velocity = (after.translation - before.translation) / (2 * step_s)
    assert np.linalg.norm(velocity) == pytest.approx(0.24, rel=1e-6)
    ahead = here.rotation.apply([1.0, 0.0, 0.0])
    np.testing.assert_allclose(velocity / 0.24, ahead, atol=1e-6)
    recipe = ready_recipe("arena", {"robots": 20})
    for number in range(0, 30, 7):
        things = image_truth(recipe.scene, recipe.shot_of(number)).things
        places = np.array(
            [one.T_world_thing.translation for one in things if one.name.startswith("robot")]
        )
        apart = np.linalg.norm(places[:, None] - places[None], axis=-1) + np.eye(20)
        assert apart.min() > 1.5 * 0.11


def test_a_held_pose_stands_still_and_then_jumps() -> None:
    poses = looking(np.zeros(3), np.array([0.0, 1.0, 0.0])), looking(np.ones(3), np.zeros(3))
    path = Held(type(poses[0]).concatenate(poses), 2.0)
    at = path.at(np.array([-1.0, 0.2, 0.26, 0.5, 9.0])).translation
    np.testing.assert_array_equal(at, [[0] * 3, [0] * 3, [1] * 3, [1] * 3, [1] * 3])


@pytest.mark.slow
def test_pictures_are_the_same_again() -> None:
    recipe = wall(columns=1, rows=1)
    np.testing.assert_array_equal(picture(recipe, 0).pixels, picture(recipe, 0).pixels)
    assert isinstance(recipe.shot.camera, Camera)


@pytest.mark.parametrize(
    ("name", "parameters", "text"),
    [
        ("attic", {}, "there is no ready-made scene 'attic'; there are floor, wall"),
        ("arena", {"robot": 3}, "arena has no parameter 'robot'; there are robots, "),
        ("arena", {"robots": "many"}, "robots: expected a whole number, found 'many'"),
        ("arena", {"robots": 1.5}, "robots: expected a whole number, found 1.5"),
        ("arena", {"robots": 47}, "expected 1 to 46 robots with markers of 4x4_50, found 47"),
        ("arena", {"height_m": float("nan")}, "height_m: expected a number, found nan"),
        ("wall", {"family": "tag99"}, "unknown marker family 'tag99'"),
        ("wall", {"columns": 40, "rows": 40}, "tag36h11 has ids 0 to 586"),
        ("wall", {"size_m": -0.1}, "must be positive"),
        ("board-sweep", {"board": "cheese"}, "expected a board as chessboard"),
        ("backlit-window", {"hdr": 1}, "hdr: expected true or false, found 1"),
    ],
)
def test_refused(name: str, parameters: dict[str, object], text: str) -> None:
    with pytest.raises(InputError, match=text):
        ready_recipe(name, parameters)
