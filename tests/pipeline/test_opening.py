"""Simulated cameras are opened like every other source."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.pipeline import open_images, tells_camera
from tagmetry.twin.camera import TwinCamera, mono_camera


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


def test_refuses_an_unknown_simulated_camera() -> None:
    with pytest.raises(InputError, match=r"expected twin:webcam, .* got twin:fisheye"):
        open_images("twin:fisheye")
