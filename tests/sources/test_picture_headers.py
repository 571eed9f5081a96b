"""The size a picture declares is read before it is decoded, and nonsense is refused in words."""

import struct
import time
import tracemalloc

import cv2
import numpy as np
import pytest
from encoded_pictures import HEIGHT_PX, WIDTH_PX, chunk, encode, png, smooth, tiff

from tagmetry.errors import InputError
from tagmetry.sources import MAX_PIXELS, decode_picture, read_header
from tagmetry.sources.content import describe

SUFFIXES = {
    ".png": "PNG",
    ".jpg": "JPEG",
    ".bmp": "BMP",
    ".tif": "TIFF",
    ".webp": "WebP",
    ".ppm": "PNM",
}


@pytest.mark.parametrize(("suffix", "kind"), SUFFIXES.items())
def test_the_header_of_what_opencv_writes(suffix, kind):
    header = read_header(encode(suffix, smooth()))
    assert (header.kind, header.width_px, header.height_px) == (kind, WIDTH_PX, HEIGHT_PX)


@pytest.mark.parametrize(
    ("suffix", "options"),
    [
        (".webp", [cv2.IMWRITE_WEBP_QUALITY, 50]),  # lossy: VP8
        (".webp", [cv2.IMWRITE_WEBP_QUALITY, 101]),  # lossless: VP8L
        (".jpg", [cv2.IMWRITE_JPEG_PROGRESSIVE, 1]),
        (".jpg", [cv2.IMWRITE_JPEG_RST_INTERVAL, 2]),
    ],
)
def test_the_header_of_the_variants(suffix, options):
    content = cv2.imencode(suffix, smooth(), options)[1].tobytes()
    header = read_header(content)
    assert (header.width_px, header.height_px) == (WIDTH_PX, HEIGHT_PX)
    assert decode_picture(content).shape == (HEIGHT_PX, WIDTH_PX, 3)


@pytest.mark.parametrize(("order", "big"), [("<", False), (">", False), ("<", True)])
def test_the_header_of_tiffs_of_both_byte_orders_and_of_big_tiff(order, big):
    header = read_header(tiff(smooth(1), order=order, big=big))
    assert (header.width_px, header.height_px) == (WIDTH_PX, HEIGHT_PX)


def test_the_header_of_an_extended_webp():
    body = b"\0" * 4 + struct.pack("<HBHB", 299, 1, 99, 0)  # width - 1 and height - 1, 24 bits each
    content = b"RIFF\0\0\0\0WEBPVP8X" + struct.pack("<I", len(body)) + body
    header = read_header(content)
    assert (header.width_px, header.height_px) == (65_536 + 300, 100)


def test_a_bitmap_from_the_top_down_has_a_positive_height():
    content = bytearray(encode(".bmp", smooth()))
    struct.pack_into("<i", content, 22, -HEIGHT_PX)
    assert read_header(bytes(content)).height_px == HEIGHT_PX


def test_comments_in_a_pnm_header():
    header = read_header(b"P5\n# made by hand\n 7\t#w\n5\n255\n" + bytes(35))
    assert (header.width_px, header.height_px) == (7, 5)


def test_a_huge_declared_size_is_refused_at_once_and_allocates_nothing():
    content = png(50_000, 50_000)
    tracemalloc.start()
    begin_s = time.perf_counter()
    with pytest.raises(InputError, match=r"50000x50000 pixels is too large: up to 200 megapixels"):
        decode_picture(content)
    elapsed_s, (_, peak_bytes) = time.perf_counter() - begin_s, tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert elapsed_s < 0.05
    assert peak_bytes < 1_000_000


@pytest.mark.parametrize(
    "content",
    [
        b"P5 20000 20000 255 ",
        b"P5 999999999999 2 255 ",
        b"RIFF\0\0\0\0WEBPVP8X" + struct.pack("<II", 10, 0) + b"\xff" * 6,
        b"\xff\xd8\xff\xc0\0\x11\x08\xff\xff\xff\xff\3",
    ],
)
def test_every_format_is_bounded(content):
    content += bytes(64)
    header = read_header(content)
    assert header.width_px * header.height_px > MAX_PIXELS
    with pytest.raises(InputError, match="too large"):
        decode_picture(content)


@pytest.mark.parametrize("size", [(0, 10), (10, 0), (0, 0)])
def test_a_picture_without_pixels_is_refused(size):
    with pytest.raises(InputError, match=f"without pixels: it declares {size[0]}x{size[1]}"):
        decode_picture(png(*size))


@pytest.mark.parametrize(
    ("content", "found"),
    [
        (b"", "an empty file"),
        (b"hello, I am no picture", "text"),
        ("größer".encode(), "text"),
        (b"  <!DOCTYPE html><p>", "HTML"),
        (b"<?xml version='1.0'?>", "XML"),
        (b"GIF89a....", "a GIF"),
        (b"%PDF-1.7", "a PDF"),
        (b"BMW drives", "text"),
        (b"\0\0\0\x20ftypisom", "an MP4 video"),
        (b"\0\0\0\x20ftypavif", "an AVIF or HEIC picture"),
        (b"RIFF\0\0\0\0AVI LIST", "an AVI video"),
        (b"\x07\x08\0\xff", r"unknown content \(begins with 07 08 00 ff\)"),
    ],
)
def test_what_is_no_picture_is_named(content, found):
    with pytest.raises(InputError, match=f"expected a picture .*, found {found}"):
        decode_picture(content)


def test_pictures_are_described_too():
    assert describe(png(1, 1)) == "a PNG picture"


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("share", [0.05, 0.3, 0.6, 0.9, 0.99])
def test_a_picture_that_is_cut_off_is_refused(suffix, share):
    content = encode(suffix, smooth())
    with pytest.raises(InputError, match=r"cut off|damaged|declares no size|found"):
        decode_picture(content[: int(len(content) * share)])


def test_the_end_marker_of_a_thumbnail_does_not_pass_for_the_pictures_own():
    picture, thumbnail = encode(".jpg", smooth()), encode(".jpg", smooth()[:8, :8])
    application = b"\xff\xe1" + struct.pack(">H", len(thumbnail) + 2) + thumbnail
    content = picture[:2] + application + picture[2:]
    assert decode_picture(content).shape == (HEIGHT_PX, WIDTH_PX, 3)
    with pytest.raises(InputError, match="JPEG that is cut off"):
        decode_picture(content[:-20])


def test_bytes_after_the_end_of_a_jpeg_do_no_harm():
    content = encode(".jpg", smooth())
    np.testing.assert_array_equal(decode_picture(content + b"more"), decode_picture(content))


def test_a_png_with_a_flipped_bit_is_refused():
    content = bytearray(encode(".png", smooth()))
    content[len(content) // 2] ^= 1
    with pytest.raises(InputError, match=r"damaged PNG .*IDAT chunk"):
        decode_picture(bytes(content))


def test_a_damaged_comment_in_a_png_does_no_harm():
    comment = bytearray(chunk(b"tEXt", b"Comment\0hello"))
    comment[-1] ^= 1
    content = png(2, 2, b"\0\1\2\0\3\4", between=bytes(comment))
    np.testing.assert_array_equal(decode_picture(content), [[1, 2], [3, 4]])


def test_a_png_without_its_end_is_refused():
    with pytest.raises(InputError, match="PNG that is cut off"):
        decode_picture(png(2, 2, b"\0\1\2\0\3\4", end=False))
