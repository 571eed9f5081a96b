"""Who drives, and whether that page is still there: a page that is gone stops all robots."""

import threading
import time

BEAT_S = 0.1  # how often a page that drives says that it is there
PATIENCE_S = 0.3  # without it for so long it is gone; robots then need some time to stand


class Watch:
    """Knows the page that drives; asked from several threads, in the wall's clock."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._page: int | None = None
        self._heard_s = 0.0

    def drive(self, page: int) -> None:
        """Let a page drive from now on, instead of any other."""
        with self._lock:
            self._page, self._heard_s = page, time.monotonic()

    def rest(self) -> None:
        """Let nobody drive."""
        with self._lock:
            self._page = None

    def hear(self, page: int) -> None:
        """Take that a page is there; of one that does not drive nothing is wanted."""
        with self._lock:
            if page == self._page:
                self._heard_s = time.monotonic()

    def is_driving(self, page: int) -> bool:
        """Say whether this page drives."""
        with self._lock:
            return page == self._page

    def is_gone(self) -> bool:
        """Say whether a page drives that was silent for too long."""
        with self._lock:
            return self._page is not None and time.monotonic() - self._heard_s > PATIENCE_S
