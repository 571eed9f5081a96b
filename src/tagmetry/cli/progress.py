"""A progress bar on standard error, where a person watches and the end is known."""

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.camera import Image, Source


def progress(source: "Source") -> Iterator["Image"]:
    """Give a source's images, and show how far it is."""
    if not sys.stderr.isatty() or source.length is None or source.length < 2:
        yield from source
        return
    from rich.console import Console
    from rich.progress import track

    console = Console(stderr=True)
    yield from track(source, source.name, total=source.length, console=console, transient=True)
