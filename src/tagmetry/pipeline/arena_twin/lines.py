"""Lines of text from another process, none of them waited for longer than is said."""

import os
import select
import time
from typing import IO

_LONGEST_BYTES = 1000


class Lines:
    """What a process says, line by line."""

    def __init__(self, output: IO[bytes]) -> None:
        """Listen to a pipe, unbuffered."""
        self._output = output
        self._begun = b""

    def next(self, patience_s: float) -> bytes | None:
        """Return the next line without its end; None where there will be none.

        Raises:
            TimeoutError: None came in time.
            ValueError: What came is no line: it does not end.
        """
        end_s = time.monotonic() + patience_s
        while b"\n" not in self._begun:
            if len(self._begun) > _LONGEST_BYTES:
                raise ValueError(f"more than {_LONGEST_BYTES} bytes without the end of a line")
            more = self._more(end_s)
            if not more:
                return None
            self._begun += more
        line, self._begun = self._begun.split(b"\n", 1)
        return line

    def _more(self, end_s: float) -> bytes:
        ready, _, _ = select.select([self._output], [], [], max(end_s - time.monotonic(), 0.0))
        if not ready:
            raise TimeoutError
        return os.read(self._output.fileno(), _LONGEST_BYTES)
