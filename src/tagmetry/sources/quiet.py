"""Keeps OpenCV from writing to the terminal while it opens or decodes what may be broken.

The level belongs to the process: it is lowered by the first who asks and restored by the last.
libjpeg writes past it; its "Corrupt JPEG data" line cannot be held back.
"""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

_LOCK = threading.Lock()
_RESTORE: list[int] = []  # the level found by each of those who are inside now
_SILENT = 0


@contextmanager
def quiet_opencv() -> Iterator[None]:
    """Silence OpenCV's own log within a `with` block."""
    from cv2.utils import logging

    with _LOCK:
        found = _RESTORE[0] if _RESTORE else logging.getLogLevel()
        _RESTORE.append(found)
        logging.setLogLevel(_SILENT)
    try:
        yield
    finally:
        with _LOCK:
            level = _RESTORE.pop()
            if not _RESTORE:
                logging.setLogLevel(level)
