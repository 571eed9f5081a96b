"""What a file holds, told from its first bytes and never from its name."""

import codecs
from typing import Literal

PictureKind = Literal["PNG", "JPEG", "BMP", "TIFF", "WebP", "PNM"]

PICTURE_SUFFIXES = (
    ".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".webp", ".pgm", ".ppm", ".pbm", ".pnm",
)  # fmt: skip
VIDEO_SUFFIXES = (
    ".mp4", ".m4v", ".mov", ".avi", ".mkv", ".webm", ".mpg", ".mpeg", ".ts", ".wmv", ".flv",
    ".mjpeg", ".mjpg", ".h264", ".gif",
)  # fmt: skip

HEAD_BYTES = 512  # this much of a file is enough to tell its content

_BMP_INFO_BYTES = (12, 40, 52, 56, 64, 108, 124)
_TIFF_MAGICS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_MARKUPS = ((b"<!doctype html", "HTML"), (b"<html", "HTML"), (b"<svg", "SVG"), (b"<?xml", "XML"))
_OTHERS = (
    (b"GIF8", "a GIF"),
    (b"%PDF", "a PDF"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"\x76\x2f\x31\x01", "an OpenEXR picture"),
    (b"\0\0\0\x0cjP  ", "a JPEG 2000 picture"),
    (b"\x1a\x45\xdf\xa3", "a Matroska video"),
)


def picture_kind(head: bytes) -> PictureKind | None:
    """Return the format of the picture that begins with these bytes, None for anything else."""
    if head.startswith(b"\x89PNG\r\n\x1a\n"):
        return "PNG"
    if head.startswith(b"\xff\xd8\xff"):
        return "JPEG"
    if head[:4] in _TIFF_MAGICS:
        return "TIFF"
    if head[:4] == b"RIFF" and head[8:12] == b"WEBP":
        return "WebP"
    if head[:1] == b"P" and head[1:2] in b"123456" and head[2:3] in b" \t\r\n#" and head[2:]:
        return "PNM"
    is_bitmap = head[:2] == b"BM" and int.from_bytes(head[14:18], "little") in _BMP_INFO_BYTES
    return "BMP" if is_bitmap else None


def describe(head: bytes) -> str:
    """Say in words what begins with these bytes."""
    if not head:
        return "an empty file"
    kind = picture_kind(head)
    if kind is not None:
        return f"a {kind} picture"
    return _container(head) or _text(head) or f"unknown content (begins with {head[:4].hex(' ')})"


def is_text(head: bytes) -> bool:
    """Say whether these bytes are text: no control characters, and valid UTF-8."""
    if any(byte < 32 and byte not in b"\t\n\r\f\x1b" for byte in head):
        return False
    try:
        codecs.getincrementaldecoder("utf-8")().decode(head)  # the last character may be cut
    except UnicodeDecodeError:
        return False
    return True


def _container(head: bytes) -> str | None:
    if head[4:8] == b"ftyp":
        is_picture = head[8:12] in (b"avif", b"heic", b"heix", b"mif1")
        return "an AVIF or HEIC picture" if is_picture else "an MP4 video"
    if head[:4] == b"RIFF" and head[8:12] == b"AVI ":
        return "an AVI video"
    return next((name for magic, name in _OTHERS if head.startswith(magic)), None)


def _text(head: bytes) -> str | None:
    if not is_text(head):
        return None
    start = head.lstrip().lower()
    return next((name for magic, name in _MARKUPS if start.startswith(magic)), "text")
