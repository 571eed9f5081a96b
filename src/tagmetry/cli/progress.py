"""A progress bar on standard error, where a person watches and the end is known."""

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from tagmetry.camera import Image, Source

Item = TypeVar("Item")


def progress(source: "Source") -> Iterator["Image"]:
    """Give a source's images, and show how far it is where the results do not show it."""
    is_watched = sys.stderr.isatty() and not sys.stdout.isatty()
    if not is_watched or source.length is None:
        yield from source
        return
    yield from _tracked(source, source.length, source.name)


def counted(items: Iterator[Item], count: int, name: str) -> Iterator[Item]:
    """Give items of which there are so many, and show how far it is where a person watches."""
    if not sys.stderr.isatty():
        yield from items
        return
    yield from _tracked(items, count, name)


def _tracked(items: Iterable[Item], count: int, name: str) -> Iterator[Item]:
    """Give items under a bar, unless there is but one."""
    if count < 2:
        yield from items
        return
    from rich.console import Console
    from rich.progress import Progress

    bar = Progress(
        console=Console(stderr=True),
        transient=True,
        redirect_stdout=False,  # it would carry off the results
    )
    with bar:
        yield from bar.track(items, total=count, description=name)
