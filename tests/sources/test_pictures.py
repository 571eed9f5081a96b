"""Pixels come out as they were stored; bad files are refused with their name."""

import os

import cv2
import numpy as np
import pytest
from encoded_pictures import (
    HEIGHT_PX,
    WIDTH_PX,
    chunk,
    encode,
    png,
    smooth,
    tiff,
    with_exif_orientation,
)  # fmt: skip

from tagmetry.camera import Camera, Source
from tagmetry.errors import InputError
from tagmetry.sources import Pictures, decode_picture, open_source, read_picture
from tagmetry.sources.quiet import quiet_opencv

LOSSLESS = [".png", ".bmp", ".tif", ".ppm"]


@pytest.mark.parametrize("suffix", LOSSLESS)
@pytest.mark.parametrize("channels", [1, 3])
def test_lossless_pictures_come_back_as_they_were(suffix, channels):
    pixels = smooth(channels)
    suffix = ".pgm" if suffix == ".ppm" and channels == 1 else suffix
    np.testing.assert_array_equal(decode_picture(encode(suffix, pixels)), pixels)


@pytest.mark.parametrize("suffix", [".png", ".tif", ".pgm"])
def test_sixteen_bits_are_kept(suffix):
    pixels = smooth(1, np.uint16)
    np.testing.assert_array_equal(decode_picture(encode(suffix, pixels)), pixels)


@pytest.mark.parametrize("suffix", [".png", ".webp", ".tif"])
def test_transparency_is_dropped(suffix):
    pixels = smooth(4)
    pixels[..., 3] = 255
    found = decode_picture(encode(suffix, pixels))
    assert found.shape == (HEIGHT_PX, WIDTH_PX, 3)
    assert np.abs(found.astype(int) - pixels[..., :3]).max() <= (60 if suffix == ".webp" else 0)


def test_a_palette_becomes_colour():
    palette = chunk(b"PLTE", bytes([255, 0, 0, 0, 255, 0]))
    content = png(2, 1, b"\0\0\1", color=3, between=palette)
    np.testing.assert_array_equal(decode_picture(content), [[[0, 0, 255], [0, 255, 0]]])


def test_colour_becomes_grey_when_asked_for():
    pixels = smooth()
    found = decode_picture(encode(".png", pixels), grey=True)
    expected = cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY)
    assert np.abs(found.astype(int) - expected).max() <= 1


@pytest.mark.parametrize("orientation", range(1, 9))
def test_orientation_is_ignored_because_intrinsics_belong_to_the_sensor(orientation):
    jpeg = encode(".jpg", smooth())
    turned = with_exif_orientation(jpeg, orientation)
    np.testing.assert_array_equal(decode_picture(turned), decode_picture(jpeg))
    pixels = smooth(1)
    np.testing.assert_array_equal(decode_picture(tiff(pixels, orientation)), pixels)


def test_floating_point_pixels_are_refused():
    with pytest.raises(InputError, match="expected a picture of 8 or 16 bits, found float32"):
        decode_picture(encode(".tif", smooth().astype(np.float32)))


@pytest.mark.parametrize("name", ["größe.png", "図 1.png", "[1].png", "a:b.png", "%03d.png"])
def test_any_name_a_file_can_have(tmp_path, name):
    path = tmp_path / name
    path.write_bytes(encode(".png", smooth()))
    (image,) = open_source(str(path))
    assert image.source == str(path)
    np.testing.assert_array_equal(image.pixels, smooth())


@pytest.mark.parametrize("shape", [(1, 1), (1, 640), (640, 1)])
def test_tiny_pictures_are_pictures(tmp_path, shape):
    path = tmp_path / "tiny.png"
    path.write_bytes(encode(".png", np.zeros(shape, np.uint8)))
    assert read_picture(path).shape == shape


def write(folder, *names):
    for value, name in enumerate(names):
        (folder / name).write_bytes(encode(".png", np.full((2, 3), value, np.uint8)))


def test_a_source_of_pictures_says_what_it_is(tmp_path):
    write(tmp_path, "a.png", "b.png")
    with open_source(tmp_path) as source:
        assert isinstance(source, Source)
        assert (source.name, source.is_live, source.length) == (str(tmp_path), False, 2)
        images = list(source)
        assert [image.sequence for image in images] == [0, 1]
        assert [image.pixels[0, 0] for image in images] == [0, 1]
        assert {(image.time_s, image.time_kind) for image in images} == {(0.0, "none")}
        assert len(list(source)) == 2  # a second time
    source.close()


def test_pictures_repeat_when_asked_to(tmp_path):
    write(tmp_path, "a.png", "b.png")
    source = open_source(tmp_path, loop=True)
    assert source.length is None
    images = [image for image, _ in zip(source, range(5), strict=False)]
    assert [image.sequence for image in images] == [0, 1, 2, 3, 4]
    assert [image.pixels[0, 0] for image in images] == [0, 1, 0, 1, 0]


def test_a_bad_file_is_named_and_the_ones_after_it_can_be_had(tmp_path):
    write(tmp_path, "a.png", "b.png", "c.png")
    (tmp_path / "b.png").write_text("I am text")
    images = iter(open_source(tmp_path))
    next(images)
    with pytest.raises(InputError, match=r"b\.png: expected a picture .*, found text"):
        next(images)
    assert next(images).sequence == 2


def test_intrinsics_travel_with_the_images_they_fit(tmp_path):
    write(tmp_path, "a.png")
    camera = Camera(3, 2, (5.0, 5.0), (1.0, 0.5))
    (image,) = open_source(tmp_path / "a.png", camera=camera)
    assert image.camera is camera
    with pytest.raises(InputError, match=r"a\.png: .*intrinsics belong to 30x20 images"):
        list(open_source(tmp_path, camera=Camera(30, 20, (5.0, 5.0), (1.0, 0.5))))


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("empty.png", b"", "found an empty file"),
        ("text.png", b"I am text", "found text"),
        ("cut.jpg", encode(".jpg", smooth())[:-9], "cut off"),
        ("large.png", png(50_000, 50_000), "50000x50000 pixels is too large"),
    ],
)
def test_a_refusal_is_one_line_with_the_name(tmp_path, name, content, words):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(InputError, match=words) as refusal:
        list(open_source(path))
    assert str(refusal.value).startswith(f"{path}: ")
    assert "\n" not in str(refusal.value)


def test_what_is_no_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="No such file"):
        read_picture(tmp_path / "missing.png")
    with pytest.raises(InputError, match="found a folder or a device"):
        read_picture(tmp_path)
    with pytest.raises(InputError, match="at least one picture"):
        Pictures([])


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_that_never_speaks_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.png")
    with pytest.raises(InputError, match="found a folder or a device"):
        list(open_source(tmp_path / "pipe.png"))


def test_opencv_keeps_quiet_and_its_log_level_comes_back(capfd):
    before = cv2.utils.logging.getLogLevel()
    with pytest.raises(InputError, match="BMP picture that is damaged"):
        decode_picture(encode(".bmp", smooth())[:-50])
    assert capfd.readouterr().err == ""
    with quiet_opencv():
        with quiet_opencv():
            assert cv2.utils.logging.getLogLevel() == 0
        assert cv2.utils.logging.getLogLevel() == 0
    assert cv2.utils.logging.getLogLevel() == before
