"""Scene files: what they mean, and one line for each mistake."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files import save_camera
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin.optics.response import Hdr
from tagmetry.twin.recipe import Recipe, pictures
from tagmetry.twin.scene_files import load_recipe
from tagmetry.twin.scenes import Steady, Waypoints
from tagmetry.twin.truth import image_truth

SIMPLE = """\
camera:
  size_px: [320, 240]
  field_of_view_deg: 60
  at: {translation_m: [0, -1, 1], looking_at_m: [0, 0, 1]}
things:
  - {marker: tag36h11, ids: [7], size: 120mm, at: {translation_m: [0, 0, 1], euler_deg: [90, 0, 0]}}
"""


@pytest.fixture
def read(tmp_path: Path):
    def reading(text: str) -> Recipe:
        path = tmp_path / "scene.yaml"
        path.write_text(text)
        return load_recipe(path)

    return reading


def with_thing(line: str) -> str:
    return SIMPLE + f"  - {line}\n"


def test_a_simple_scene(read) -> None:
    recipe = read(SIMPLE)
    assert (recipe.count, recipe.seed) == (1, 0)
    camera = recipe.shot.camera
    assert camera.focal_px[0] == pytest.approx(160 / np.tan(np.radians(30)))
    assert camera.center_px == (159.5, 119.5)
    (one,) = image_truth(recipe.scene, recipe.shot).markers
    half_px = 0.06 * camera.focal_px[0]
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half_px + camera.center_px
    np.testing.assert_allclose(one.corners_px, square, atol=1e-9)
    assert one.visible_fraction == pytest.approx(1.0, abs=1e-9)


def test_the_three_ways_to_turn_a_thing(read) -> None:
    """Facing -y, with its top up: by angles, by a quaternion, by what it looks at."""
    half = np.sqrt(0.5)
    turns = [
        "euler_deg: [90, 0, 0]",
        f"rotation_xyzw: [{half}, 0, 0, {half}]",
        "looking_at_m: [0, -3, 1]",
    ]
    for turn in turns:
        recipe = read(SIMPLE.replace("euler_deg: [90, 0, 0]", turn))
        T_world_marker = recipe.scene.things[0].path.at(np.zeros(1))[0]
        expected = Rotation.from_euler("x", 90, degrees=True).as_matrix()
        np.testing.assert_allclose(T_world_marker.rotation.as_matrix(), expected, atol=1e-12)


def test_every_kind_of_thing(read, tmp_path: Path) -> None:
    picture = tmp_path / "poster.png"
    cv2.imwrite(str(picture), np.full((20, 30), 255, np.uint8))
    recipe = read(
        SIMPLE
        + "  - {board: 'charuco:4x3:30mm:22mm:5x5_100', at: {translation_m: [0.3, 0, 1]}}\n"
        + "  - {cube: tag36h11, ids: [1, 2, null, 4, 5, null], side: 10cm, size: 80mm}\n"
        + "  - {surface: [4, 3], brightness: 0.6}\n"
        + "  - {texture: checker, size: [1, 0.5], cell: 100mm}\n"
        + "  - {texture: noise, size: [1, 1], cell: 100mm, seed: 3}\n"
        + f"  - {{texture: '{picture}', size: [0.3, 0.2], cell: 1cm}}\n"
        + "  - {window: [1, 1.2], glow: 20}\n"
        + "  - {box: [0.4, 0.3, 0.2], at: {translation_m: [1, 1, 0.1]}}\n"
        + "  - {clutter: 5, space: [2, 2, 1], seed: 4}\n"
    )
    marker, board, cube, plain, checker, noise, poster, window, box, clutter = recipe.scene.things
    assert [len(marker.markers), len(board.markers), len(cube.markers)] == [1, 6, 4]
    assert (len(cube.sheets), len(box.sheets), len(clutter.sheets)) == (10, 6, 5)
    assert plain.sheets[0].paper == 0.6
    np.testing.assert_array_equal(checker.sheets[0].prints[0].ink[0, :3], [1, 0, 1])
    assert noise.sheets[0].prints[0].ink.shape == (10, 10)
    np.testing.assert_array_equal(poster.sheets[0].prints[0].ink, np.zeros((20, 30)))
    assert window.sheets[0].glow == 20
    assert box.sheets[4].T_thing_sheet.translation[2] == pytest.approx(0.1)


def test_a_row_of_markers(read) -> None:
    ids = SIMPLE.replace("ids: [7]", "ids: [3, 1, 2], gap: 30mm")
    markers = read(ids).scene.things[0].markers
    assert [one.id for one in markers] == [3, 1, 2]
    x_m = [one.T_body_marker.translation[0] for one in markers]
    assert x_m == pytest.approx([-0.15, 0.0, 0.15])


def test_paths_and_rates(read) -> None:
    moving = SIMPLE.replace(
        "looking_at_m: [0, 0, 1]}", "looking_at_m: [0, 0, 1], velocity_m_s: [0.1, 0, 0]}"
    ).replace(
        "at: {translation_m: [0, 0, 1], euler_deg: [90, 0, 0]}}",
        "path: {motion: straight, waypoints: [{time_s: 0, translation_m: [0, 0, 1], "
        "euler_deg: [90, 0, 0]}, {time_s: 2, translation_m: [1, 0, 1], euler_deg: [90, 0, 0]}]}}",
    )
    recipe = read(moving + "duration_s: 0.5\nrate_hz: 20\nseed: 8\n")
    assert (recipe.count, recipe.seed, recipe.shot_of(3).time_s) == (10, 8, 0.15)
    assert isinstance(recipe.shot.path, Steady)
    thing = recipe.scene.things[0].path
    assert isinstance(thing, Waypoints)
    np.testing.assert_allclose(thing.at(np.array([0.5]))[0].translation, [0.25, 0, 1])
    at = recipe.shot.path.at(np.array([2.0]))[0].translation
    np.testing.assert_allclose(at, [0.2, -1, 1])


def test_a_camera_file_and_everything_of_a_camera(read, tmp_path: Path) -> None:
    save_camera(Camera(320, 240, (300.0, 301.0), (160.0, 119.0)), tmp_path / "cam.yaml")
    text = SIMPLE.replace(
        "  size_px: [320, 240]\n  field_of_view_deg: 60\n", f"  file: {tmp_path}/cam.yaml\n"
    ).replace(
        "things:",
        "  optics: {blur_px: 0.5, vignetting: 0.4, veil: 0.02, "
        "thin_lens: {focal: 8mm, f_number: 4, pixel: 0.003mm, focus: 1}}\n"
        "  shutter: {exposure_s: 0.01, line_s: 0.00001}\n"
        "  sensor: {bits: 12, response: {kind: hdr, stops: 5}}\n"
        "  zoom: {factor: 2, size_px: [160, 120]}\n"
        "light: {ambient: 0.5, lamps: [{at_m: [0, 0, 2], strength: 3}]}\nthings:",
    )
    recipe = read(text)
    shot = recipe.shot
    assert shot.camera.focal_px == (300.0, 301.0)
    assert (shot.optics.lens.aperture_m, shot.optics.focus_m) == pytest.approx((0.002, 1.0))
    assert (shot.shutter.exposure_s, shot.shutter.line_s) == (0.01, 1e-5)
    assert (shot.sensor.bits, shot.sensor.response) == (12, Hdr(5.0, 0.25))
    assert shot.picture_camera.size_px == (160, 120)
    assert recipe.scene.light.lamps[0].strength == 3


def test_ready_made_scenes_with_parameters(read) -> None:
    recipe = read("ready: wall\ncolumns: 2\nsize_m: 0.2\nimages: 3\n")
    assert recipe.count == 3
    assert len(recipe.scene.things[1].markers) == 4


def test_pictures_are_the_same_for_any_number_of_jobs(read) -> None:
    recipe = read(SIMPLE + "images: 4\n")
    alone, together = (list(pictures(recipe, jobs)) for jobs in (1, 2))
    assert [one.number for one in together] == [0, 1, 2, 3]
    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one.pixels, other.pixels)
    assert (alone[0].pixels != alone[1].pixels).any()  # its noise is its own


AWAY, BEHIND = "translation_m: [0, 0, 1], euler_deg: [-90, 0, 0]", "translation_m: [0, -3, 1]"
AT = "translation_m: [0, 0, 1], euler_deg: [90, 0, 0]"
MISTAKES = {
    "nothing there": ("at: {translation_m: [0, -1, 1]", "at: {translation_m: [9, 9, 1]", "nothing"),
    "behind": (AT, BEHIND, "marker tag36h11 7 is behind the camera, at a depth of -2 m"),
    "turned away": (AT, AWAY, "marker tag36h11 7 is turned away from the camera, by 180 degrees"),
    "outside": (AT, "translation_m: [9, 0, 1], euler_deg: [90, 0, 0]", "outside the picture"),
    "family": ("tag36h11", "tag99", "things.0: unknown marker family 'tag99'; there are "),
    "id": ("ids: [7]", "ids: [9999]", "things.0: family tag36h11 has ids 0 to 586"),
    "same id twice": ("ids: [7]", "ids: [7, 7]", "has tag36h11 id 7 twice"),
    "not finite": ("[0, 0, 1], euler", "[0, .nan, 1], euler", "at.translation_m.1: expected"),
    "infinite": ("[0, 0, 1], euler", "[0, 1e999, 1], euler", "the number 1e999 is too large"),
    "unknown key": ("size: 120mm", "size: 120mm, colour: red", "there is no key 'colour'"),
    "unknown key at the top": ("things:", "nonsense: 1\nthings:", "there is no key 'nonsense'"),
    "size zero": ("120mm", "0mm", "size: expected a length above 0"),
    "size negative": ("120mm", "-0.1", "size: expected greater than 0, found -0.1"),
    "size in words": ("120mm", "large", "size: expected a length above 0"),
    "no kind": ("marker: tag36h11", "tag: tag36h11", "a thing is one of marker, board, cube"),
    "two kinds": ("marker: tag36h11", "marker: tag36h11, window: [1, 1]", "found marker, window"),
    "a huge picture": ("[320, 240]", "[20000, 20000]", "100 megapixels, found 20000x20000"),
    "a tiny picture": ("[320, 240]", "[2, 2]", "found 2x2"),
    "no size": ("  size_px: [320, 240]\n", "", "expected size_px"),
    "two focal lengths": ("_deg: 60", "_deg: 60\n  focal_px: 300", "give one of focal_px and"),
    "field of view": ("_deg: 60", "_deg: 180", "field_of_view_deg: expected less than 175"),
    "two turns": ("euler_deg: [90", "looking_at_m: [0, 0, 0], euler_deg: [90", "give one of"),
    "no unit quaternion": ("euler_deg: [90, 0, 0]", "rotation_xyzw: [1, 1, 0, 0]", "length 1"),
    "looks at itself": ("looking_at_m: [0, 0, 1]", "looking_at_m: [0, -1, 1]", "look at itself"),
    "no camera": ("camera:", "cameras:", "there is no key 'cameras'"),
    "too many images": ("things:", "images: 1000000\nthings:", "expected 1 to 100000 images"),
    "images and duration": ("things:", "images: 2\nduration_s: 1\nthings:", "give one of images"),
    "a board": ("marker: tag36h11, ids: [7], size: 120mm", "board: cheese", "expected a board as"),
    "a missing camera": (
        "size_px: [320, 240]\n  field_of_view_deg: 60",
        "file: no.yaml",
        "no.yaml",
    ),
    "a texture": (
        "marker: tag36h11, ids: [7], size: 120mm",
        "texture: noise, size: [1000, 1000], cell: 1mm",
        "a texture has at most 4000000 cells",
    ),
    "a lens": ("_deg: 60", "_deg: 60\n  lens: {coefficients: [1, 2, 3]}", "expected 0, 4, 5, 8"),
    "ready": (SIMPLE, "ready: attic", "there is no ready-made scene 'attic'"),
    "ready with more": (SIMPLE, "ready: wall\nthings: []", "wall has no parameter 'things'"),
    "no YAML": (SIMPLE, "{{{", "scene.yaml: "),
    "a list": (SIMPLE, "- 1", "expected keys with values"),
    "empty": (SIMPLE, " ", "the file is empty"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_are_told_in_one_line(name: str, read) -> None:
    old, new, text = MISTAKES[name]
    assert old in SIMPLE
    with pytest.raises(InputError) as refused:
        read(SIMPLE.replace(old, new))
    assert text in str(refused.value)
    assert str(refused.value).count("\n") == 0
    assert "scene.yaml" in str(refused.value)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no\.yaml: there is no such file"):
        load_recipe(tmp_path / "no.yaml")
