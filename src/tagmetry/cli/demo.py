"""`tagmetry demo`: the whole way once, on a rendered scene or on your picture; then an arena."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import CameraFile, Size, measurement
from tagmetry.errors import InputError

if TYPE_CHECKING:
    from tagmetry.pipeline.demonstration import Comparison, Demonstration

_SCENARIO, _ROBOTS, _FILM_S = "leader_follower", 12, 5.0


def demo(
    *,
    image: Annotated[
        Path | None, typer.Option(help="Your picture instead of the rendered scene.")
    ] = None,
    family: Annotated[
        list[str] | None,
        typer.Option("--family", help="With --image: family to look for; all by default."),
    ] = None,
    size: Size = None,
    camera: CameraFile = None,
    out: Annotated[Path, typer.Option(help="Folder for what is written.")] = Path("demo-out"),
    seed: Annotated[int, typer.Option(min=0, help="Seed of the rendered picture's noise.")] = 0,
    live: Annotated[
        bool,
        typer.Option(help="Then open the live page with twelve simulated robots, until Ctrl-C."),
    ] = False,
    headless: Annotated[
        bool,
        typer.Option(
            help="With --live: a video and a summary instead, as where there is no screen."
        ),
    ] = False,
) -> None:
    """Print, render, detect, measure and compare; or do it on your own picture."""
    if image is not None:
        _on_picture(image, family or _reliable_families(), size, camera, out)
        return
    _refuse_without("--image", {"--family": family, "--size": size, "--camera": camera})
    if not live:
        _refuse_without("--live", {"--headless": headless})
    import numpy as np

    from tagmetry.pipeline.demonstration import demonstrate

    _tell(demonstrate(out, np.random.default_rng(seed)))
    if live:
        _show_arena(out, headless=headless)


def _refuse_without(missing: str, options: Mapping[str, object]) -> None:
    """Refuse options that say something only beside one that is not given."""
    given = [option for option, value in options.items() if value]
    if given:
        raise InputError(f"{', '.join(given)} says nothing without {missing}; give it too")


def _show_arena(out: Path, *, headless: bool) -> None:
    """Let twelve robots drive, leaders and followers: on a page, or in a video."""
    from tagmetry.cli.display import has_browser
    from tagmetry.cli.live_page import require_server, serve, write_film

    if headless or not has_browser():
        typer.echo("\nTwelve simulated robots, leaders and followers, in a video:\n")
        write_film(out / "arena.mp4", _SCENARIO, _ROBOTS, _FILM_S)
        return
    require_server()
    from tagmetry.live.opening import opened_page
    from tagmetry.live.show.programme import Programme

    typer.echo("\nTwelve simulated robots, leaders and followers, in your browser:\n")
    programme = Programme(_SCENARIO, _ROBOTS, out / "recordings")
    with opened_page(programme, "127.0.0.1", 0) as page:
        serve(page, browser=True)


def _on_picture(
    image: Path, families: list[str], size: str | None, camera: Path | None, out: Path
) -> None:
    from tagmetry.cli.report import result_lines
    from tagmetry.pipeline.demonstration import write_results
    from tagmetry.sources import open_source

    task = measurement(families, size, camera)
    with open_source(image, camera=task.camera) as source:
        picture = next(iter(source))
    result = task.measure(picture)
    out.mkdir(parents=True, exist_ok=True)
    files = write_results(out, picture, result, task)
    typer.echo("\n".join(result_lines(result)))
    if not result.markers:
        typer.echo(f"Why? Ask: tagmetry doctor {image}")
    elif task.camera is None or task.sizes_m is None:
        typer.echo("Where they are in space needs --size and --camera.")
    typer.echo("wrote " + ", ".join(map(str, files)))


def _reliable_families() -> list[str]:
    """Return the families whose markers random squares do not imitate, without their subsets."""
    from tagmetry.markers import family, family_names

    names = [name for name in family_names() if not name.endswith(("_50", "_100", "_250"))]
    families = [family(name) for name in names]
    return [one.name for one in families if one.chance_of_random_match(one.forgiven_bits) <= 1e-3]


def _tell(done: "Demonstration") -> None:
    typer.echo(f"{len(done.comparisons)} markers measured in a rendered picture, against truth:\n")
    typer.echo(
        f"{'id':>4} {'x mm':>10} {'y mm':>10} {'z mm':>10} {'± mm':>6} {'error mm':>9} "
        f"{'error °':>8} {'distance':>9}"
    )
    typer.echo("\n".join(map(_row, done.comparisons)))
    typer.echo(
        "\ndistance: of the whole pose from the truth, in its own standard deviations; about"
    )
    typer.echo("2.4 is normal for six numbers, above 5 would be a wrong covariance.")
    if done.missing:
        typer.echo(f"not measured (hidden or too oblique): {', '.join(map(str, done.missing))}")
    typer.echo("\nwrote " + ", ".join(map(str, done.files)))


def _row(one: "Comparison") -> str:
    x_mm, y_mm, z_mm = (1000 * value for value in one.position_m)
    spread_mm = 1000 * sum(s * s for s in one.deviation_m) ** 0.5
    error_mm = 1000 * sum(e * e for e in one.error_m) ** 0.5
    return (
        f"{one.id:>4} {x_mm:>10.2f} {y_mm:>10.2f} {z_mm:>10.2f} {spread_mm:>6.2f} "
        f"{error_mm:>9.2f} {one.error_deg:>8.3f} {one.distance:>9.1f}"
    )
