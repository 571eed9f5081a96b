"""How much memory this program holds."""

import os
from pathlib import Path

_STATUS = Path("/proc/self/statm")


def resident_bytes() -> int | None:
    """Return what lies in the computer's memory; None where the system does not say."""
    try:
        pages = int(_STATUS.read_text().split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError, AttributeError):
        return None
