"""Video files: every image with its own time, damage reported, nothing endless."""

import itertools
import os
from contextlib import suppress
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from tagmetry.camera import Camera, Source
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.sources import VideoFile, open_source
from tagmetry.sources.decoding import decoded

av = pytest.importorskip("av")

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))
SIZE = (64, 48)
LEVELS = [40, 80, 120, 160, 200]
PTS = [0, 1, 2, 10, 11]  # in tenths of a second: a gap after the third


def write_video(path, *, codec="mpeg4", pix_fmt="yuv420p", pts=PTS, levels=LEVELS, size=SIZE):
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=10)
        stream.width, stream.height, stream.pix_fmt = *size, pix_fmt
        stream.time_base = stream.codec_context.time_base = Fraction(1, 10)
        for place, level in zip(pts, levels, strict=True):
            frame = av.VideoFrame.from_ndarray(picture(level, size), format="bgr24")
            frame.pts, frame.time_base = place, Fraction(1, 10)
            container.mux(stream.encode(frame.reformat(format=pix_fmt)))
        container.mux(stream.encode(None))
    return path


def picture(level, size=SIZE):
    pixels = np.full((size[1], size[0], 3), level, np.uint8)
    pixels[:, : size[0] // 2, 0] = 255 - level
    return pixels


@pytest.fixture
def video(tmp_path):
    return write_video(tmp_path / "größe: 1%d.mp4")


def test_images_times_and_numbers_come_back(video):
    with open_source(video) as source:
        assert isinstance(source, Source)
        assert (source.name, source.is_live, source.length) == (str(video), False, 5)
        images = list(source)
    np.testing.assert_allclose([image.time_s for image in images], np.array(PTS) / 10, atol=1e-9)
    assert [image.sequence for image in images] == [0, 1, 2, 3, 4]
    assert {(image.time_kind, image.source) for image in images} == {("capture", str(video))}
    for image, level in zip(images, LEVELS, strict=True):
        assert image.pixels.shape == (48, 64, 3)
        assert np.abs(image.pixels.astype(int) - picture(level)).mean() < 6
    assert source.warnings == ()


def test_a_source_can_be_read_twice(video):
    source = open_source(video)
    assert [i.pixels.sum() for i in source] == [i.pixels.sum() for i in source]


def test_grey_is_the_luma_that_is_in_the_video(video):
    with av.open(str(video)) as container:
        expected = [f.to_ndarray()[:48] for f in container.decode(video=0)]
    found = [image.pixels for image in open_source(video, grey=True)]
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("width_px", [62, 50])
def test_rows_that_are_padded_in_memory_are_read_straight(tmp_path, width_px):
    path = write_video(tmp_path / "odd.avi", size=(width_px, 30))
    for image in open_source(path, grey=True):
        assert image.pixels.shape == (30, width_px)
        assert image.pixels[:, width_px // 2 + 8 :].std() < 3


@pytest.mark.parametrize(
    ("pix_fmt", "grey", "dtype", "shape"),
    [
        ("gray", False, np.uint8, (48, 64)),
        ("gray", True, np.uint8, (48, 64)),
        ("gray10le", False, np.uint16, (48, 64)),
        ("bgr0", True, np.uint8, (48, 64)),
        ("yuv420p10le", True, np.uint8, (48, 64)),
        ("yuv420p10le", False, np.uint8, (48, 64, 3)),
    ],
)
def test_other_kinds_of_pixels(tmp_path, pix_fmt, grey, dtype, shape):
    path = write_video(tmp_path / "lossless.mkv", codec="ffv1", pix_fmt=pix_fmt)
    image = next(iter(open_source(path, grey=grey)))
    assert (image.pixels.dtype, image.pixels.shape) == (dtype, shape)


def test_lossless_grey_is_exact(tmp_path):
    path = write_video(tmp_path / "grey.mkv", codec="ffv1", pix_fmt="gray")
    for image, level in zip(open_source(path), LEVELS, strict=True):
        assert np.abs(image.pixels[:, 40:].astype(int) - level).max() <= 1


def test_a_repeated_video_goes_on_in_time_and_number(video):
    source = open_source(video, loop=True)
    assert source.length is None
    images = [image for image, _ in zip(source, range(12), strict=False)]
    assert [image.sequence for image in images] == list(range(12))
    assert (np.diff([image.time_s for image in images]) > 0).all()


def test_intrinsics_of_another_size_are_refused(video):
    with pytest.raises(InputError, match="belong to 30x20 images, this one is 64x48"):
        list(open_source(video, camera=Camera(30, 20, (5.0, 5.0), (1.0, 0.5))))


def test_closing_ends_the_iteration(video):
    source = open_source(video)
    images = iter(source)
    next(images)
    source.close()
    source.close()
    assert list(images) == []
    assert list(source) == []


def test_a_video_that_was_cut_off_gives_what_it_has_and_says_so(tmp_path):
    levels, pts = list(range(20, 220, 5)), list(range(40))
    whole = write_video(
        tmp_path / "a.avi", codec="mjpeg", pix_fmt="yuvj420p", levels=levels, pts=pts
    )
    cut = tmp_path / "cut.avi"
    cut.write_bytes(whole.read_bytes()[: int(whole.stat().st_size * 0.6)])
    source = open_source(cut)
    count = len(list(source))
    assert 0 < count < 40
    assert f"the file announces 40 images, {count} could be decoded" in source.warnings


def test_damage_in_the_middle_costs_only_what_it_hits(tmp_path):
    levels, pts = list(range(20, 220, 5)), list(range(40))
    path = write_video(tmp_path / "a.mp4", levels=levels, pts=pts)
    content = bytearray(path.read_bytes())
    middle = len(content) // 3
    content[middle : middle + 200] = b"\xff" * 200
    path.write_bytes(content)
    count = len(list(open_source(path)))
    assert 20 <= count <= 40


def test_what_the_decoder_holds_is_not_lost_with_the_rest_of_the_file(tmp_path):
    path = write_video(tmp_path / "a.mp4", levels=list(range(20, 220, 5)), pts=list(range(40)))
    warnings = []
    with av.open(str(path)) as container:
        broken = BreaksOff(container, after=20)
        assert len(list(decoded(broken, warnings.append, grey=True))) == 20
    assert warnings == ["the rest cannot be read: bad sector"]


class BreaksOff:
    def __init__(self, container, after):
        self.container, self.streams, self.after = container, container.streams, after

    def demux(self, stream):
        yield from itertools.islice(self.container.demux(stream), self.after)
        raise av.InvalidDataError(5, "bad sector")


@pytest.mark.parametrize("suffix", [".avi", ".mp4", ".mkv"])
def test_mutated_videos_end_or_are_refused(tmp_path, suffix):
    seed = write_video(tmp_path / f"seed{suffix}").read_bytes()
    rng, path = np.random.default_rng(5), tmp_path / f"mutated{suffix}"
    for _ in range(60):
        content = bytearray(seed)
        for place in rng.integers(0, len(content), 12):
            content[place] = rng.integers(256)
        path.write_bytes(content[: rng.integers(len(content) // 2, len(content) + 1)])
        with suppress(InputError):
            assert len(list(open_source(path))) < 100


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("empty.mp4", b"", "found an empty file"),
        ("text.mp4", b"I am text", "expected a picture or a video, found text"),
        ("page.avi", b"<!doctype html>", "found HTML"),
        ("noise.mp4", bytes(range(256)) * 9, "cannot be opened"),
        ("list.m3u8", b"#EXTM3U\n#EXTINF:1,\nfile:///etc/passwd\n", "found text"),
        ("list.ffconcat", b"ffconcat version 1.0\nfile a.mp4\n", "found text"),
    ],
)
def test_what_is_no_video_is_refused(tmp_path, name, content, words):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(InputError, match=words) as refusal:
        list(open_source(path))
    assert str(refusal.value).startswith(f"{path}: ")


def test_a_film_without_pictures_is_refused(tmp_path):
    path = tmp_path / "sound.mp4"
    with av.open(str(path), "w") as container:
        stream = container.add_stream("aac", rate=48000)
        frame = av.AudioFrame.from_ndarray(np.zeros((1, 1024), np.float32), "fltp", "mono")
        frame.sample_rate = 48000
        container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    with pytest.raises(InputError, match="no video stream"):
        open_source(path)


def test_folders_and_missing_files_are_refused(tmp_path):
    with pytest.raises(InputError, match="found a folder or a device"):
        VideoFile(tmp_path)
    with pytest.raises(InputError, match="No such file"):
        VideoFile(tmp_path / "missing.mp4")


def test_without_pyav_the_missing_part_is_named(video, monkeypatch):
    monkeypatch.setattr("tagmetry.sources.avlib.find_spec", lambda _: None)
    with pytest.raises(MissingExtraError, match=r"reading video .* 'tagmetry\[video\]'"):
        open_source(video)
    with pytest.raises(MissingExtraError, match="reading video"):
        open_source("rtsp://camera/stream")


@pytest.mark.parametrize(
    ("name", "count", "size", "last_s"),
    [
        ("field_video/fieldvideo/short.mp4", 3, (1920, 1080), 2 / 30),
        ("field_video/altfieldvideo/short.avi", 3, (1920, 1080), 2 / 30),
        ("rigid_tools/data/output.avi", 10, (640, 480), 0.9),
        ("rigid_tools/data/multipattern.avi", 10, (640, 480), 1 / 3),
        ("rigid_tools/data/12markers.avi", 1, (640, 480), 1 / 30),
    ],
)
def test_real_videos(name, count, size, last_s):
    if not (DATA / name).is_file():
        pytest.skip(f"{name} is not in the data folder")
    images = list(open_source(DATA / name, grey=True))
    assert len(images) == count
    assert {(image.width_px, image.height_px) for image in images} == {size}
    assert images[-1].time_s == pytest.approx(last_s, abs=1e-6)
