"""A rendered scene whose truth is known, as files that the command reads."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import Scene

from tagmetry.files import save_camera
from tagmetry.twin import render, showcase


@pytest.fixture(scope="session")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    folder = tmp_path_factory.mktemp("scene")
    picture, camera = folder / "scene.png", folder / "camera.yaml"
    rng = np.random.default_rng(7)
    grey = render(showcase.markers(), showcase.T_camera_wall, showcase.CAMERA, rng)
    cv2.imwrite(str(picture), grey)
    save_camera(showcase.CAMERA, camera)
    return Scene(str(picture), str(camera))


@pytest.fixture(scope="session")
def small_picture(scene: Scene, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The scene's middle: 320x240 pixels with one marker, quick to read."""
    path = tmp_path_factory.mktemp("small") / "small.png"
    cv2.imwrite(str(path), cv2.imread(scene.picture)[90:330, 30:350])
    return path
