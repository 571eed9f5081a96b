"""Cameras of this computer, by number or device, through OpenCV."""

from typing import TYPE_CHECKING

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.connection import Connection, ConnectionLostError, Opener
from tagmetry.sources.quiet import quiet_opencv

if TYPE_CHECKING:
    from cv2 import VideoCapture


def camera_opener(
    device: int | str, *, size_px: tuple[int, int] | None = None, grey: bool = False
) -> Opener:
    """Return what opens a camera.

    Args:
        device: Number, or path such as /dev/video0.
        size_px: (width, height) to ask the camera for: the size that its intrinsics belong to.
        grey: Convert colour to grey.
    """
    return lambda: _Capture(_open(device, size_px), grey=grey)


class _Capture(Connection):
    def __init__(self, capture: "VideoCapture", *, grey: bool) -> None:
        self._capture, self._grey = capture, grey

    def read(self) -> AnyPixels:
        import cv2

        try:
            is_read, pixels = self._capture.read()
        except cv2.error as error:
            raise ConnectionLostError("the camera failed") from error
        if not is_read:
            raise ConnectionLostError("the camera gives no more images; is it still plugged in?")
        is_wanted = pixels.ndim == 2 or not self._grey
        return pixels if is_wanted else cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY)

    def close(self) -> None:
        self._capture.release()


def _open(device: int | str, size_px: tuple[int, int] | None) -> "VideoCapture":
    import cv2

    backend = cv2.CAP_ANY if isinstance(device, int) else cv2.CAP_V4L2  # others would open files
    with quiet_opencv():
        capture = cv2.VideoCapture(device, backend)
    if not capture.isOpened():
        raise InputError("the camera cannot be opened: is it plugged in, and used by nobody else?")
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)  # old images are of no use
    if size_px is not None:
        capture.set(cv2.CAP_PROP_FRAME_WIDTH, size_px[0])
        capture.set(cv2.CAP_PROP_FRAME_HEIGHT, size_px[1])
    return capture
