"""`tagmetry live`: the arena in a browser; or, without one, as a short video and a summary."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from tagmetry.cli.live_page import require_server, serve, write_film


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
    camera: Annotated[
        str,
        typer.Option(
            help="Calibrated on the page: 0, a stream, a video, or twin, a simulated one."
        ),
    ] = "twin",
    cameras: Annotated[
        Path, typer.Option(help="Folder for cameras that are calibrated on the page.")
    ] = Path("cameras"),
    maps: Annotated[
        Path, typer.Option(help="Folder of marker maps, cameras and images to locate from.")
    ] = Path("maps"),
    headless: Annotated[
        Path | None, typer.Option(help="Write a video instead of serving a page: .mp4.")
    ] = None,
    seconds: Annotated[
        float, typer.Option(min=0.1, max=600.0, help="With --headless: simulated time.")
    ] = 10.0,
) -> None:
    """Show simulated robots on a page in the browser: look, command, record."""
    if headless is not None:
        write_film(headless, scenario, robots, seconds)
        return
    require_server()
    from tagmetry.live.opening import opened_page
    from tagmetry.live.rooms.every import Furniture
    from tagmetry.live.show.programme import Programme

    programme = Programme(scenario, robots, recordings, controller or (), pictures, eye)
    with opened_page(programme, address, port, Furniture(camera, cameras, maps)) as page:
        serve(page, browser=browser)
