"""Small encoded pictures that the tests of this folder share; written by hand where it matters."""

import struct
import zlib

import cv2
import numpy as np

WIDTH_PX, HEIGHT_PX = 60, 40


def smooth(channels=3, dtype=np.uint8):
    rng = np.random.default_rng(4)
    top = np.iinfo(dtype).max
    noise = rng.integers(0, top, (HEIGHT_PX, WIDTH_PX, channels)).astype(dtype)
    return cv2.GaussianBlur(noise, (5, 5), 0).reshape(noise.shape).squeeze()


def encode(suffix, pixels):
    return cv2.imencode(suffix, pixels)[1].tobytes()


def chunk(name, body):
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


def png(width_px, height_px, raw=b"", *, color=0, between=b"", end=True):
    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width_px, height_px, 8, color, 0, 0, 0))
    body = between + chunk(b"IDAT", zlib.compress(raw)) + (chunk(b"IEND", b"") if end else b"")
    return b"\x89PNG\r\n\x1a\n" + header + body


def tiff(pixels, orientation=1, *, order="<", big=False):
    height_px, width_px = pixels.shape
    values = {256: width_px, 257: height_px, 258: 8, 259: 1, 262: 1, 273: 0, 274: orientation,
              277: 1, 278: height_px, 279: pixels.size}  # fmt: skip
    entry, offset, count = ("HHQQ", "Q", "Q") if big else ("HHII", "I", "H")
    start = 16 if big else 8
    size = struct.calcsize("<" + entry)
    values[273] = start + struct.calcsize(count) + size * len(values) + struct.calcsize(offset)
    head = {("<", False): b"II*\0", (">", False): b"MM\0*", ("<", True): b"II+\0\x08\0\0\0"}
    out = head[order, big] + struct.pack(order + offset, start)
    out += struct.pack(order + count, len(values))
    for tag, value in values.items():
        out += struct.pack(order + "HH" + offset, tag, 16 if big else 4, 1)
        out += struct.pack(order + offset, value)
    return out + struct.pack(order + offset, 0) + pixels.tobytes()


def with_exif_orientation(jpeg, orientation):
    exif = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0"
    exif += struct.pack("<HHI", orientation, 0, 0)
    return jpeg[:2] + b"\xff\xe1" + struct.pack(">H", len(exif) + 2) + exif + jpeg[2:]
