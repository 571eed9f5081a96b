import sys
from dataclasses import replace

import av
import cv2
import numpy as np
import pytest

from tagmetry.camera.image import Image
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.record import open_overlay


def grey_image(level: int, time_s: float = 0.0, shape=(48, 64), source="pictures/a b.png") -> Image:
    pixels = np.full((*shape, 3), level, np.uint8)
    return Image(pixels, time_s, "capture", round(time_s * 10), source)


def write(path, *images) -> None:
    with open_overlay(path) as writer:
        for image in images:
            writer.write(image)


def read_video(path) -> list[av.VideoFrame]:
    with av.open(str(path)) as container:
        return list(container.decode(video=0))


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".PNG", ".jpeg"])
def test_a_picture_is_read_back(tmp_path, suffix) -> None:
    path = tmp_path / f"out{suffix}"
    write(path, grey_image(100))
    np.testing.assert_array_equal(cv2.imread(str(path)), grey_image(100).pixels)


def test_several_pictures_are_named_after_their_images(tmp_path) -> None:
    write(tmp_path / "o_{stem}_{sequence}.png", grey_image(1), grey_image(2, 0.3))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["o_a_b_000000.png", "o_a_b_000003.png"]


def test_an_address_becomes_a_harmless_name(tmp_path) -> None:
    write(tmp_path / "{stem}.png", grey_image(1, source="rtsp://user:secret@host/../live?x=1"))
    assert [p.name for p in tmp_path.iterdir()] == ["live_x_1.png"]


def test_refuses_a_second_image_of_the_same_name(tmp_path) -> None:
    with pytest.raises(InputError, match=r"such as .*o_\{stem\}_\{sequence\}\.png"):
        write(tmp_path / "o.png", grey_image(1), grey_image(2))
    assert cv2.imread(str(tmp_path / "o.png"))[0, 0, 0] == 1


@pytest.mark.parametrize("shape", [(48, 64), (47, 63), (1, 1), (1, 640)])
def test_a_video_holds_every_image_at_its_time(tmp_path, shape) -> None:
    path, times_s = tmp_path / "out.mp4", [100.0, 100.1, 100.15, 101.0]
    write(path, *[grey_image(60 * i, t, shape) for i, t in enumerate(times_s)])
    frames = read_video(path)
    assert [frame.time for frame in frames] == pytest.approx([0.0, 0.1, 0.15, 1.0], abs=1e-4)
    even = tuple(n + n % 2 for n in shape)
    for i, frame in enumerate(frames):
        pixels = frame.to_ndarray(format="bgr24")
        assert pixels.shape[:2] == even
        assert abs(pixels.mean() - 60 * i) < 3


def test_a_build_without_h264_writes_mpeg4(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(av, "codecs_available", {"mpeg4"})
    path = tmp_path / "out.mp4"
    write(path, grey_image(60), grey_image(120, 0.5))
    with av.open(str(path)) as container:
        assert container.streams.video[0].codec_context.name == "mpeg4"
    assert [frame.time for frame in read_video(path)] == pytest.approx([0.0, 0.5], abs=1e-4)


def test_images_without_a_time_follow_at_thirty_per_second(tmp_path) -> None:
    path = tmp_path / "out.mp4"
    times_s = (0.0, 0.0, -5.0, float("nan"), float("inf"))
    write(path, *[replace(grey_image(9), time_s=t) for t in times_s])
    assert [frame.time for frame in read_video(path)] == pytest.approx(
        [0, 1 / 30, 2 / 30, 3 / 30, 4 / 30], abs=1e-4
    )


def test_a_first_image_without_a_time_does_not_stop_the_clock(tmp_path) -> None:
    path = tmp_path / "out.mp4"
    write(path, replace(grey_image(9), time_s=float("nan")), grey_image(9, 1.0), grey_image(9, 2.0))
    assert [frame.time for frame in read_video(path)] == pytest.approx(
        [0, 1 / 30, 2 / 30], abs=1e-4
    )


def test_a_video_is_of_one_size(tmp_path) -> None:
    with pytest.raises(InputError, match="the first is 64x48, this one 50x40; write pictures"):
        write(tmp_path / "out.mp4", grey_image(1), grey_image(1, 1.0, (40, 50)))
    assert list(tmp_path.iterdir()) == []


def test_no_image_is_no_video(tmp_path) -> None:
    with pytest.raises(InputError, match="no image to make a video of"):
        write(tmp_path / "out.mp4")
    assert list(tmp_path.iterdir()) == []


def write_until(path, stop: BaseException) -> None:
    with open_overlay(path) as writer:
        writer.write(grey_image(50))
        raise stop


def test_a_failed_video_leaves_the_old_one(tmp_path) -> None:
    path = tmp_path / "out.mp4"
    path.write_text("old")
    with pytest.raises(RuntimeError):
        write_until(path, RuntimeError())
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_ctrl_c_keeps_the_video_so_far(tmp_path) -> None:
    path = tmp_path / "out.mp4"
    with pytest.raises(KeyboardInterrupt):
        write_until(path, KeyboardInterrupt())
    assert len(read_video(path)) == 1


@pytest.mark.parametrize("name", ["o.png", "o.mp4"])
def test_refuses_a_folder_that_does_not_exist(tmp_path, name) -> None:
    with pytest.raises(InputError, match="cannot write"):
        write(tmp_path / "none" / name, grey_image(1))


def test_an_unknown_suffix_of_an_overlay_lists_those_there_are(tmp_path) -> None:
    with pytest.raises(InputError, match=r"ending in \.png, \.jpg, \.jpeg, \.mp4, found \.gif"):
        open_overlay(tmp_path / "o.gif")


def test_names_the_part_that_writes_video(tmp_path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(MissingExtraError, match=r"writing video .*tagmetry\[video\]"):
        write(tmp_path / "o.mp4", grey_image(1))
    assert list(tmp_path.iterdir()) == []


def test_refuses_a_picture_that_jpeg_cannot_hold(tmp_path) -> None:
    with pytest.raises(InputError, match="70000x1 does not fit this format"):
        write(tmp_path / "o.jpg", grey_image(1, shape=(1, 70_000)))
    assert list(tmp_path.iterdir()) == []
