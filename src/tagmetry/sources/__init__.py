"""Images in: pictures, videos, cameras and network streams behind `tagmetry.camera.Source`."""

from tagmetry.sources.connection import Connection, ConnectionLostError, Opener
from tagmetry.sources.content import PICTURE_SUFFIXES, VIDEO_SUFFIXES
from tagmetry.sources.decode import decode_picture
from tagmetry.sources.headers import MAX_PIXELS, PictureHeader, read_header
from tagmetry.sources.live import LiveSource
from tagmetry.sources.open import open_source
from tagmetry.sources.pictures import Pictures, read_picture
from tagmetry.sources.state import LiveState, LiveTiming, OnState
from tagmetry.sources.video import VideoFile

__all__ = [
    "MAX_PIXELS",
    "PICTURE_SUFFIXES",
    "VIDEO_SUFFIXES",
    "Connection",
    "ConnectionLostError",
    "LiveSource",
    "LiveState",
    "LiveTiming",
    "OnState",
    "Opener",
    "PictureHeader",
    "Pictures",
    "VideoFile",
    "decode_picture",
    "open_source",
    "read_header",
    "read_picture",
]
