"""A source of images together with the controls of its camera."""

from collections.abc import Generator
from contextlib import contextmanager

from tagmetry.camera import ControlledSource
from tagmetry.pipeline.opening import open_images
from tagmetry.sources.controls import controlled


@contextmanager
def opened(spec: str) -> Generator[ControlledSource]:
    """Open a camera with its controls: `0`, `/dev/video2`, `twin:webcam`.

    Raises:
        InputError: It is not there, or has no controls.
    """
    with open_images(spec) as source, controlled(source) as camera:
        yield camera
