"""The live page from the command line: served until Ctrl-C, or a short video in its place."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from tagmetry.live.opening import LivePage


def require_server() -> None:
    """Raise MissingExtraError where the live page cannot be served."""
    from importlib.util import find_spec

    from tagmetry.errors import MissingExtraError

    if not all(map(find_spec, ("fastapi", "uvicorn", "websockets"))):
        raise MissingExtraError("the live page", "live")


def serve(page: "LivePage", *, browser: bool) -> None:
    """Say where the page is, open the browser if it is wanted, and serve until Ctrl-C."""
    typer.echo(f"The live page is at {page.url} until you press Ctrl-C.")
    typer.echo("Looking is free on this computer. To command, paste this token on the page:")
    typer.echo(page.token)
    if browser:
        _open_soon(page.url)
    page.serve()


def write_film(path: Path, scenario: str, robots: int, seconds: float) -> None:
    """Write a video of a scenario and tell what its run came to."""
    from tagmetry.cli.arena_twin import tell_summary
    from tagmetry.live.film import film

    tell_summary(*film(path, scenario, robots, seconds))
    typer.echo(f"wrote {path}")


def _open_soon(url: str) -> None:
    """Open the browser when the server is likely to listen; the page tries again by itself."""
    import threading
    import webbrowser

    timer = threading.Timer(1.0, webbrowser.open, (url,))
    timer.daemon = True
    timer.start()
