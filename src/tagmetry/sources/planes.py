"""The pixels of a decoded video picture: BGR, or the grey that is already in it."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry.arrays import AnyPixels, GreyPixels

if TYPE_CHECKING:
    from av import VideoFrame

_BYTE_LUMA = (
    "yuv420p", "yuvj420p", "yuv422p", "yuvj422p", "yuv444p", "yuvj444p", "yuv440p", "yuvj440p",
    "yuv411p", "yuv410p", "nv12", "nv21", "gray",
)  # fmt: skip


def pixels_of(picture: "VideoFrame", *, grey: bool) -> AnyPixels:
    """Return the pixels of a decoded picture.

    A grey video stays grey (16 bits where it has more than 8). For `grey` the luma plane is copied
    as it is, without conversion: in a video of limited range, black is 16 and white 235.

    Returns:
        Grey (height, width) or BGR (height, width, 3), uint8 or uint16.
    """
    layout = picture.format.name
    if layout.startswith("gray") and picture.format.components[0].bits > 8:
        return np.asarray(picture.to_ndarray(format="gray16le"))
    if layout == "gray" or (grey and layout in _BYTE_LUMA):
        return _luma(picture)
    return np.asarray(picture.to_ndarray(format="gray" if grey else "bgr24"))


def _luma(picture: "VideoFrame") -> GreyPixels:
    plane = picture.planes[0]
    rows: GreyPixels = np.frombuffer(memoryview(plane), dtype=np.uint8).reshape(-1, plane.line_size)
    return np.array(rows[: picture.height, : picture.width])
