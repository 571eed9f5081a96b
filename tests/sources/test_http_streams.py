"""Streams over HTTP from a small server on this computer."""

import itertools
import threading
import time
from functools import partial
from http.server import BaseHTTPRequestHandler, SimpleHTTPRequestHandler, ThreadingHTTPServer

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.sources import LiveSource, LiveTiming, open_source
from tagmetry.sources.streams import stream_opener

av = pytest.importorskip("av")

SIZE = (48, 64)


def jpeg(number):
    pixels = np.full((*SIZE, 3), 20, np.uint8)
    pixels[:, : 2 + number % 60] = 230
    return cv2.imencode(".jpg", pixels)[1].tobytes()


class Mjpeg(BaseHTTPRequestHandler):
    """Sends `count` images per connection, then hangs up (or stays silent for `silent_s`)."""

    count, silent_s, connections = 10_000, 0.0, 0

    def do_GET(self):
        type(self).connections += 1
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        self.end_headers()
        try:
            self._send_images()
        except (BrokenPipeError, ConnectionResetError):
            return

    def _send_images(self):
        for number in range(self.count):
            body = jpeg(number)
            head = f"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {len(body)}\r\n\r\n"
            self.wfile.write(head.encode() + body + b"\r\n")
            time.sleep(0.01)
        time.sleep(self.silent_s)

    def log_message(self, *_):
        """Keep quiet."""


@pytest.fixture
def serve():
    servers = []

    def start(handler):
        server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        server.daemon_threads = True
        servers.append(server)
        threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
        return f"http://user:secret@127.0.0.1:{server.server_port}/video.mjpg"

    yield start
    for server in servers:
        server.shutdown()
        server.server_close()


def test_images_of_an_mjpeg_stream_arrive_in_order(serve):
    with open_source(serve(type("Endless", (Mjpeg,), {}))) as source:
        images = list(itertools.islice(source, 5))
        assert source.is_live
    assert "secret" not in images[0].source
    assert images[0].pixels.shape == (*SIZE, 3)
    sequences = [image.sequence for image in images]
    assert sequences == sorted(set(sequences))
    assert {image.time_kind for image in images} == {"arrival"}
    bright = [(image.pixels[20, :, 0] > 128).sum() for image in images]
    assert bright == sorted(bright)


def test_grey_from_a_stream(serve):
    with open_source(serve(type("Endless", (Mjpeg,), {})), grey=True) as source:
        assert next(iter(source)).pixels.shape == SIZE


def test_a_stream_that_breaks_off_is_connected_again(serve):
    handler, seen = type("Short", (Mjpeg,), {"count": 40}), []
    opener = stream_opener(serve(handler))
    timing = LiveTiming(first_pause_s=0.05)
    with LiveSource("stream", opener, on_state=seen.append, timing=timing) as source:
        later = next(image for image in source if handler.connections >= 3)
    assert later.sequence > 40
    kinds = [state.kind for state in seen]
    assert kinds[:4] == ["running", "lost", "reconnecting", "running"]
    assert seen[1].reason in ("the stream ended", "the rest cannot be read: Input/output error")


def test_a_stream_that_falls_silent_is_lost(serve):
    handler, seen = type("Silent", (Mjpeg,), {"count": 40, "silent_s": 20.0}), []
    lost = threading.Event()
    opener = stream_opener(serve(handler), timeout_s=0.5)

    def on_state(state):
        seen.append(state)
        if state.kind == "lost":
            lost.set()

    with LiveSource("stream", opener, on_state=on_state):
        assert lost.wait(10.0)
    assert "no answer in time" in seen[1].reason


@pytest.fixture
def play_list(tmp_path):
    with av.open(str(tmp_path / "live.m3u8"), "w", format="hls") as container:
        stream = container.add_stream("mpeg2video", rate=25)
        stream.width, stream.height, stream.pix_fmt = SIZE[1], SIZE[0], "yuv420p"
        for level in range(0, 200, 5):
            pixels = np.full((*SIZE, 3), level, np.uint8)
            container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="bgr24")))
        container.mux(stream.encode(None))
    return tmp_path / "live.m3u8"


class Files(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        """Keep quiet."""


def test_an_hls_stream(serve, play_list):
    address = serve(partial(Files, directory=play_list.parent))
    with open_source(address.replace("video.mjpg", "live.m3u8")) as source:
        assert next(iter(source)).pixels.shape == (*SIZE, 3)


def test_a_play_list_cannot_make_us_read_our_own_files(serve, play_list):
    content = play_list.read_text().replace("live0.ts", (play_list.parent / "live0.ts").as_uri())
    play_list.write_text(content)
    address = serve(partial(Files, directory=play_list.parent))
    refusal = pytest.raises(InputError, match="cannot be opened")
    with open_source(address.replace("video.mjpg", "live.m3u8")) as source, refusal:
        next(iter(source))


class Page(BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200 if "404" not in self.path else 404)
        self.end_headers()
        self.wfile.write(b"<!doctype html><p>hello" * 9)

    def log_message(self, *_):
        """Keep quiet."""


def test_a_page_is_no_stream(serve):
    refusal = pytest.raises(InputError, match=r"127.0.0.1:\d+/video.mjpg: cannot be opened")
    with open_source(serve(Page)) as source, refusal:
        next(iter(source))


def test_nobody_answers():
    refusal = pytest.raises(InputError, match="cannot be opened: Connection refused")
    with open_source("http://127.0.0.1:9/video.mjpg") as source, refusal:
        next(iter(source))
