"""Cameras of this computer, by number or device, through OpenCV."""

import threading
from collections.abc import Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.connection import Connection, ConnectionLostError
from tagmetry.sources.quiet import quiet_opencv

if TYPE_CHECKING:
    from cv2 import VideoCapture

_OPENING_S = 5.0  # for another thread that opens it
_PATIENCE_S = 2.0  # for an image under way


def camera_opener(
    device: int | str, *, size_px: tuple[int, int] | None = None, grey: bool = False
) -> "CameraOpener":
    """Return what opens a camera.

    Args:
        device: Number, or path such as /dev/video0.
        size_px: (width, height) to ask the camera for: the size that its intrinsics belong to.
        grey: Convert colour to grey.
    """
    return CameraOpener(device, size_px, grey=grey)


class CameraOpener:
    """Opens a camera, again after each loss, and gets at the properties of the one that is open."""

    def __init__(
        self, device: int | str, size_px: tuple[int, int] | None = None, *, grey: bool = False
    ) -> None:
        """Open nothing yet; the arguments are those of `camera_opener`."""
        self.device = device
        self._size_px, self._grey = size_px, grey
        self._turn = threading.Lock()  # OpenCV's captures serve one thread at a time
        self._is_open = threading.Event()
        self._capture: VideoCapture | None = None

    def __call__(self) -> Connection:
        """Open the camera."""
        self._capture = _open(self.device, self._size_px)
        self._is_open.set()
        return _Capture(self._capture, self._turn, grey=self._grey)

    def get(self, prop: int) -> float:
        """Return a property of the open camera, as `cv2.VideoCapture` has them."""
        with self._taken() as capture:
            return float(capture.get(prop))

    def set(self, prop: int, value: float) -> bool:
        """Set a property of the open camera and say whether it was taken."""
        with self._taken() as capture:
            return bool(capture.set(prop, value))

    @contextmanager
    def _taken(self) -> "Generator[VideoCapture]":
        """Give the open camera, between two of its images."""
        if not self._is_open.wait(_OPENING_S) or self._capture is None:
            raise InputError(f"camera {self.device} is not open: is it plugged in?")
        if not self._turn.acquire(timeout=_PATIENCE_S):
            raise InputError(f"camera {self.device} does not answer")
        try:
            yield self._capture
        finally:
            self._turn.release()


class _Capture(Connection):
    def __init__(self, capture: "VideoCapture", turn: threading.Lock, *, grey: bool) -> None:
        self._capture, self._turn, self._grey = capture, turn, grey

    def read(self) -> AnyPixels:
        import cv2

        try:
            with self._turn:
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
