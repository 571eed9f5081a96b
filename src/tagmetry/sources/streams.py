"""Network streams through PyAV: RTSP, RTMP, and MJPEG or HLS over HTTP."""

from typing import TYPE_CHECKING
from urllib.parse import urlsplit, urlunsplit

from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.avlib import open_container, require_av
from tagmetry.sources.connection import Connection, ConnectionLostError, Opener
from tagmetry.sources.decoding import decoded

if TYPE_CHECKING:
    from av.container import InputContainer

SCHEMES = ("rtsp", "rtsps", "rtmp", "rtmps", "http", "https")

_TIMEOUT_S = 5.0
_PROTOCOLS = "rtsp,rtsps,rtmp,rtmps,rtp,udp,tcp,tls,http,https,httpproxy,hls,crypto"  # no files
_AT_ONCE = {"fflags": "nobuffer", "flags": "low_delay", "analyzeduration": "1000000"}
_OPTIONS = {"rtsp_transport": "tcp"} | _AT_ONCE  # over UDP, lost packets smear the picture


def stream_opener(address: str, *, grey: bool = False, timeout_s: float = _TIMEOUT_S) -> Opener:
    """Return what opens a stream.

    Args:
        address: With its scheme, one of `SCHEMES`.
        grey: Give the luma instead of BGR, which costs less.
        timeout_s: How long to wait for an answer.

    Raises:
        MissingExtraError: PyAV is not installed.
    """
    require_av()
    return lambda: _Stream(open_container(address, _PROTOCOLS, _OPTIONS, timeout_s), grey=grey)


def public_address(address: str) -> str:
    """Return an address without its user and password, for results and messages."""
    parts = urlsplit(address)
    return urlunsplit(parts._replace(netloc=parts.netloc.rpartition("@")[2]))


class _Stream(Connection):
    def __init__(self, container: "InputContainer", *, grey: bool) -> None:
        self._container = container
        self._trouble = "the stream ended"
        self._images = decoded(container, self._note, grey=grey, threading="SLICE")

    def read(self) -> AnyPixels:
        for _, pixels in self._images:
            return pixels
        raise ConnectionLostError(self._trouble)

    def close(self) -> None:
        self._images.close()
        self._container.close()

    def _note(self, trouble: str) -> None:
        self._trouble = trouble
