"""An image as a recording holds it: a picture file in JSON, as common viewers know it."""

import base64
import binascii
import math
from typing import Literal

import numpy as np

from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.record.line import printable
from tagmetry.record.mcap.plain_json import json_text, parse_object
from tagmetry.sources import decode_picture

Format = Literal["jpeg", "png"]

_NO_DATA = b'"data":""'


def image_text(image: Image, jpeg_quality: int | None) -> bytes:
    """Return an image as it is recorded: JPEG of a quality, or lossless PNG for None."""
    whole_s = math.floor(image.time_s)
    content = binascii.b2a_base64(_encoded(image.pixels, jpeg_quality), newline=False)
    text = json_text(
        {
            "timestamp": {"sec": whole_s, "nsec": int((image.time_s - whole_s) * 1e9)},
            "frame_id": "camera",
            "data": "",
            "format": "png" if jpeg_quality is None else "jpeg",
            "tagmetry": {
                "time_s": image.time_s,
                "time_kind": image.time_kind,
                "sequence": image.sequence,
                "source": printable(image.source),
            },
        }
    )
    before, after = text.split(_NO_DATA, 1)  # a megabyte need not go through JSON's encoder
    return b"".join((before, _NO_DATA[:-1], content, b'"', after))


def parse_image(text: bytes) -> Image:
    """Return the image that was recorded.

    Raises:
        InputError: It is none.
    """
    told = parse_object(text)
    try:
        about = told["tagmetry"]
        return Image(
            decode_picture(base64.b64decode(told["data"], validate=True)),
            float(about["time_s"]),
            about["time_kind"],
            int(about["sequence"]),
            str(about["source"]),
        )
    except (KeyError, TypeError, ValueError, binascii.Error) as error:
        raise InputError(f"expected a recorded image, got something else: {error}") from None


def picture_of(text: bytes) -> tuple[int, Format, bytes]:
    """Return the number of a recorded image, its format and its file's content.

    Raises:
        InputError: It is none.
    """
    told = parse_object(text)
    try:
        content = base64.b64decode(told["data"], validate=True)
        kind: Format = "png" if told["format"] == "png" else "jpeg"
        return int(told["tagmetry"]["sequence"]), kind, content
    except (KeyError, TypeError, ValueError, binascii.Error) as error:
        raise InputError(f"expected a recorded image, got something else: {error}") from None


def _encoded(pixels: AnyPixels, jpeg_quality: int | None) -> bytes:
    import cv2

    if jpeg_quality is None:
        _, content = cv2.imencode(".png", pixels, [cv2.IMWRITE_PNG_COMPRESSION, 1])
        return content.tobytes()
    shown = pixels if pixels.dtype == np.uint8 else (pixels >> 8).astype(np.uint8)
    _, content = cv2.imencode(".jpg", shown, [cv2.IMWRITE_JPEG_QUALITY, jpeg_quality])
    return content.tobytes()
