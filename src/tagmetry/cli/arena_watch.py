"""`tagmetry arena watch`: what an arena on another computer sees."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.link.computers import ArenaView

_PATIENCE_S = 3.0


def watch(
    endpoint: Annotated[
        str, typer.Argument(metavar="ENDPOINT", help="The arena's computer: tcp/192.168.1.5:7447.")
    ],
    name: Annotated[str, typer.Option(help="The arena's name, as its file has it.")] = "arena",
    key_file: Annotated[
        Path | None,
        typer.Option(help="File with the arena's view_key, where its file has one."),
    ] = None,
    limit: Annotated[int | None, typer.Option(min=1, help="Stop after so many images.")] = None,
) -> None:
    """Print a line of JSON for each image of an arena that runs on another computer."""
    from tagmetry.link.computers import ArenaView
    from tagmetry.pipeline.arena.lines import sight_line

    with ArenaView(endpoint, name, _key(key_file)) as view:
        _wait_for(view, endpoint, name)
        was_heard, shown = True, 0
        while limit is None or shown < limit:
            sight = view.wait()
            was_heard = _tell_of_silence(view, was_heard=was_heard)
            if sight is not None:
                typer.echo(sight_line(sight))
                shown += 1


def _key(path: Path | None) -> bytes:
    from tagmetry.files.text import named_errors, read_text
    from tagmetry.link import parse_key
    from tagmetry.link.computers.keys import OPEN_KEY

    if path is None:
        return OPEN_KEY
    with named_errors(path):
        return parse_key(read_text(path).strip())


def _wait_for(view: "ArenaView", endpoint: str, name: str) -> None:
    """Wait until the arena is heard.

    Raises:
        InputError: It is not.
    """
    from tagmetry.errors import InputError

    end_s = time.monotonic() + _PATIENCE_S
    while not view.is_heard:
        if time.monotonic() > end_s:
            refused = sum(view.refused.values())
            raise InputError(
                f"{endpoint}: no arena {name!r} is heard there ({refused} packets were refused); "
                "--name is that of the arena's file, and --key-file has its view_key"
            )
        view.wait(0.1)


def _tell_of_silence(view: "ArenaView", *, was_heard: bool) -> bool:
    """Say once that the arena is heard no more, or again; return whether it is."""
    is_heard = view.is_heard
    if was_heard and not is_heard:
        typer.echo("tagmetry: the arena has fallen silent; waiting for it", err=True)
    if is_heard and not was_heard:
        typer.echo("tagmetry: the arena is heard again", err=True)
    return is_heard
