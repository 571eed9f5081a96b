"""The controls of a source of images."""

import platform

from tagmetry.camera import ControlledSource, Controls, Source
from tagmetry.errors import InputError
from tagmetry.sources.cameras import CameraOpener
from tagmetry.sources.controls.opencv import OpenCvControls
from tagmetry.sources.controls.v4l2_controls import V4l2Controls
from tagmetry.sources.live import LiveSource


def open_controls(source: Source) -> Controls:
    """Return what can be set on the camera that a source gives images of.

    Args:
        source: A camera of this computer (`open_source(0)`), or one that has its own controls, as
            the twin's.

    Raises:
        InputError: It has none, as a file or a stream; or the device cannot be opened.
    """
    if isinstance(source, ControlledSource):
        return source.controls
    opener = source.opener if isinstance(source, LiveSource) else None
    if not isinstance(opener, CameraOpener):
        raise InputError(
            f"{source.name} has no controls: expected a camera of this computer or the twin's"
        )
    if platform.system() == "Linux":
        device = opener.device
        return V4l2Controls.open(f"/dev/video{device}" if isinstance(device, int) else device)
    return OpenCvControls(opener)
