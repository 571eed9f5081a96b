"""A progress bar on standard error, where a person watches and the end is known."""

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.camera import Image, Source


def progress(source: "Source") -> Iterator["Image"]:
    """Give a source's images, and show how far it is where the results do not show it."""
    is_watched = sys.stderr.isatty() and not sys.stdout.isatty()
    if not is_watched or source.length is None or source.length < 2:
        yield from source
        return
    from rich.console import Console
    from rich.progress import Progress

    bar = Progress(
        console=Console(stderr=True),
        transient=True,
        redirect_stdout=False,  # it would carry off the results
    )
    with bar:
        yield from bar.track(source, total=source.length, description=source.name)
