"""`tagmetry detect --track`: the same lines as without, from videos."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import Scene

from tagmetry.cli.main import run


@pytest.fixture(scope="module")
def video(scene: Scene, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The scene's middle, moving by 4 pixels per image."""
    av = pytest.importorskip("av", reason="videos need the part video")
    pixels = cv2.imread(scene.picture)
    path: Path = tmp_path_factory.mktemp("video") / "video.mp4"
    with av.open(str(path), "w") as container:
        stream = container.add_stream("mpeg4", rate=30)
        stream.width, stream.height, stream.pix_fmt = 640, 360, "yuv420p"
        stream.bit_rate = 20_000_000
        for k in range(5):
            part = np.ascontiguousarray(pixels[100:460, 40 + 4 * k : 680 + 4 * k])
            container.mux(stream.encode(av.VideoFrame.from_ndarray(part, "bgr24")))
        container.mux(stream.encode())
    return str(path)


def lines(capsys: pytest.CaptureFixture) -> list[dict]:
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def test_the_lines_are_those_of_whole_images(video: str, capsys: pytest.CaptureFixture) -> None:
    assert run(["detect", video, video, "--json"]) == 0
    whole = lines(capsys)
    assert run(["detect", video, video, "--json", "--track"]) == 0
    tracked = lines(capsys)
    assert len(tracked) == len(whole) == 10
    for one, other in zip(tracked, whole, strict=True):
        assert one.keys() == other.keys()
        assert [marker["id"] for marker in one["markers"]] == [m["id"] for m in other["markers"]]
        for marker, same in zip(one["markers"], other["markers"], strict=True):
            assert marker.keys() == same.keys()
            np.testing.assert_allclose(marker["corners_px"], same["corners_px"], atol=0.05)
    assert whole[0]["markers"]


def test_pictures_are_refused(small_picture: Path, capsys: pytest.CaptureFixture) -> None:
    assert run(["detect", str(small_picture), "--track"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "small.png: expected images with times" in error


def test_explaining_needs_whole_images(small_picture: Path, capsys: pytest.CaptureFixture) -> None:
    assert run(["detect", str(small_picture), "--track", "--explain"]) == 2
    assert "--explain looks at whole images, --track does not" in capsys.readouterr().err
