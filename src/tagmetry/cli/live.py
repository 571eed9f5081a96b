"""`tagmetry live`: the arena in a browser; or, without one, as a short video and a summary."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

if TYPE_CHECKING:
    from tagmetry.live.opening import LivePage


def live(  # noqa: PLR0913 (each argument is an option)
    *,
    scenario: Annotated[
        str,
        typer.Option(
            help="leader_follower, aggregate, disperse, formation, wander; or a --controller's name"
        ),
    ] = "leader_follower",
    robots: Annotated[int, typer.Option(min=1, max=100, help="How many, simulated.")] = 12,
    controller: Annotated[
        list[Path] | None,
        typer.Option(help="A Python file with a function control(view), to be chosen on the page."),
    ] = None,
    address: Annotated[
        str, typer.Option(help="Interface to serve at; beyond this computer all need the token.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="0 for a free one.")] = 8765,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,
    pictures: Annotated[bool, typer.Option(help="Show what the camera sees.")] = True,
    eye: Annotated[
        Literal["corners", "pictures"],
        typer.Option(
            help="What is measured: the markers' corners with noise, or pictures by the detector."
        ),
    ] = "corners",
    recordings: Annotated[
        Path, typer.Option(help="Folder for what is recorded on the page.")
    ] = Path("recordings"),
    headless: Annotated[
        Path | None, typer.Option(help="Write a video instead of serving a page: .mp4.")
    ] = None,
    seconds: Annotated[
        float, typer.Option(min=0.1, max=600.0, help="With --headless: simulated time.")
    ] = 10.0,
) -> None:
    """Show simulated robots on a page in the browser: look, command, record."""
    if headless is not None:
        _film(headless, scenario, robots, seconds)
        return
    _require_server()
    from tagmetry.live.opening import opened_page

    with opened_page(
        scenario,
        robots,
        address,
        port,
        recordings,
        controllers=controller or (),
        pictures=pictures,
        eye=eye,
    ) as page:
        _tell(page)
        if browser:
            _open_soon(page.url)
        page.serve()


def _film(path: Path, scenario: str, robots: int, seconds: float) -> None:
    from tagmetry.cli.arena_twin import tell_summary
    from tagmetry.live.film import film

    tell_summary(*film(path, scenario, robots, seconds))
    typer.echo(f"wrote {path}")


def _require_server() -> None:
    from importlib.util import find_spec

    from tagmetry.errors import MissingExtraError

    if not all(map(find_spec, ("fastapi", "uvicorn", "websockets"))):
        raise MissingExtraError("the live page", "live")


def _tell(page: "LivePage") -> None:
    typer.echo(f"The live page is at {page.url} until you press Ctrl-C.")
    typer.echo("Looking is free on this computer. To command, paste this token on the page:")
    typer.echo(page.token)


def _open_soon(url: str) -> None:
    """Open the browser when the server is likely to listen; the page tries again by itself."""
    import threading
    import webbrowser

    timer = threading.Timer(1.0, webbrowser.open, (url,))
    timer.daemon = True
    timer.start()
