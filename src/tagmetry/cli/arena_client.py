"""`tagmetry arena client`: the sources of a robot's end of the link."""

from pathlib import Path
from typing import Annotated

import typer


def client(
    folder: Annotated[Path, typer.Argument(help="Where to; made where there is none.")],
) -> None:
    """Write the C client for robots: for ESP32 and for computers with sockets."""
    from tagmetry.files.atomic import refusing, write_atomically
    from tagmetry.link.client.sources import client_sources

    with refusing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    for name, content in client_sources().items():
        write_atomically(folder / name, content)
        typer.echo(f"wrote {folder / name}")


def key() -> None:
    """Print a new random key for a robot."""
    from tagmetry.link import new_key

    typer.echo(new_key())
