"""Simulated cameras are opened like every other source."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.pipeline import open_images, tells_camera
from tagmetry.twin.camera import TwinCamera, mono_camera
from tagmetry.twin.recipe import picture, pictures
from tagmetry.twin.scene_files import load_recipe


def test_opens_a_simulated_camera_with_its_intrinsics() -> None:
    with open_images("twin:mono") as source:
        assert isinstance(source, TwinCamera)
        image = next(iter(source))
    assert image.camera is not None
    assert image.camera.size_px == mono_camera().size_px


def test_intrinsics_that_are_given_are_not_replaced() -> None:
    with open_images("twin:mono", camera=mono_camera().sensor) as source:
        assert next(iter(source)).camera is None


def test_opens_everything_else_as_before(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "grey.png"), np.full((9, 12), 77, np.uint8))
    with open_images(str(tmp_path / "grey.png")) as source:
        assert [image.width_px for image in source] == [12]
    assert not tells_camera(str(tmp_path / "grey.png"))
    assert tells_camera("twin:mono")


SCENE = """
camera:
  size_px: [160, 120]
  field_of_view_deg: 60
  at: {translation_m: [0.05, -0.1, 0.3], looking_at_m: [0, 0, 0]}
things: [{marker: tag36h11, ids: [7], size: 80mm}]
images: 3
"""


def test_opens_the_file_of_a_scene_with_as_many_pictures_as_it_says(tmp_path: Path) -> None:
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE, "utf-8")
    recipe = load_recipe(path)
    with open_images(f"twin:{path}") as source:
        assert (source.is_live, source.length) == (False, 3)
        images = list(source)
    assert [image.sequence for image in images] == [0, 1, 2]
    assert [image.time_s for image in images] == [one.truth.time_s for one in pictures(recipe)]
    np.testing.assert_array_equal(images[2].pixels, picture(recipe, 2).pixels)
    assert images[0].camera is not None
    assert images[0].camera.focal_px == recipe.shot.picture_camera.focal_px


def test_a_scene_tells_no_intrinsics_beside_others_and_ends_when_closed(tmp_path: Path) -> None:
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE, "utf-8")
    with open_images(f"twin:{path}", camera=load_recipe(path).shot.camera) as source:
        images = iter(source)
        assert next(images).camera is None
        source.close()
        assert list(images) == []


def test_opens_a_ready_made_scene() -> None:
    with open_images("twin:board-sweep") as source:
        assert source.length == 35
        assert source.name == "twin board-sweep"


def test_refuses_what_the_twin_does_not_have(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"expected twin:webcam, .*twin:room.* got twin:fisheye"):
        open_images("twin:fisheye")
    with pytest.raises(InputError, match=r"nowhere\.yaml"):
        open_images(f"twin:{tmp_path / 'nowhere.yaml'}")
