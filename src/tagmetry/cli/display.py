"""Whether there is a screen and a browser to open a page in."""

import os
import sys


def has_browser() -> bool:
    """Say whether somebody may see a page here: not on a server, nor where tests are run."""
    if os.environ.get("CI"):
        return False
    if sys.platform not in ("win32", "darwin") and not _has_screen():
        return False
    import webbrowser

    try:
        webbrowser.get()
    except webbrowser.Error:
        return False
    return True


def _has_screen() -> bool:
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))
