"""`tagmetry lens`: drive zoom and focus so that a small marker is measured over a metre."""

from pathlib import Path
from typing import Annotated

import typer

from tagmetry.cli.options import Json

app = typer.Typer(
    help="Zoom, focus and calibration driven by the measured depth of a small marker.",
    no_args_is_help=True,
)

Camera = Annotated[
    str, typer.Argument(metavar="CAMERA", help="Camera with controls: 0, /dev/video2, twin:webcam.")
]
LensPath = Annotated[Path, typer.Option("--lens", help="What is known of the lens, with its bank.")]
MarkerSize = Annotated[str, typer.Option("--size", help="Side of the black square: 10mm.")]
MarkerId = Annotated[int | None, typer.Option("--id", help="Only this marker.")]
Family = Annotated[str, typer.Option(help="Family of the marker, or a dictionary file.")]
Out = Annotated[Path | None, typer.Option(help="File of JSON lines, one for each image.")]
Images = Annotated[int | None, typer.Option(min=1, help="End after so many images.")]


def _measures(name: str, told: str, *, tracks: bool) -> None:
    """Add a command that finds and measures a marker."""

    @app.command(name, help=told)
    def measure(
        *,
        camera: Camera,
        lens: LensPath,
        size: MarkerSize,
        marker_id: MarkerId = None,
        family: Family = "tag36h11",
        json_: Json = False,
        out: Out = None,
        images: Images = None,
    ) -> None:
        from tagmetry.cli.lens_run import Wanted, run

        run(Wanted(camera, lens, size, marker_id, family, tracks, images), out, json_=json_)


_measures(
    "scan",
    "Find a marker at an unknown distance and measure it as well as the camera can.",
    tracks=False,
)
_measures("track", "Find a marker, then follow it with zoom and focus until Ctrl-C.", tracks=True)


@app.command()
def demo(
    *,
    depth: Annotated[str, typer.Option(help="Where the marker stands: 0.05m to 1.05m.")] = "0.5m",
    turn: Annotated[float, typer.Option(help="How far it is turned, degrees.")] = 30.0,
    seed: Annotated[int, typer.Option(min=0, help="Of the images' noise.")] = 0,
    json_: Json = False,
    out: Out = None,
) -> None:
    """Measure a 10 mm marker with a simulated webcam, and compare with the truth."""
    from tagmetry.cli.lens_trace import told
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.pipeline.lens.demonstration import demonstrated

    depth_m = parse_length_m(depth)
    steps = demonstrated(depth_m, turn, seed)
    typer.echo("calibrating the simulated webcam at 31 focus values ...", err=True)
    last = told(steps, out, json_=json_)
    if last is not None and last.found is not None and not json_:
        error_m = last.found.depth_m - depth_m
        typer.echo(
            f"true depth {1000 * depth_m:.1f} mm: error {1e6 * error_m:+.0f} µm "
            f"({100 * error_m / depth_m:+.3f} %), {abs(error_m) / last.found.depth_sd_m:.1f} "
            "stated deviations"
        )


@app.command(name="focus-curve")
def focus_curve(
    *,
    camera: Camera,
    depth: Annotated[str, typer.Option(help="Where the marker stands now: 0.25m.")],
    pairs: Annotated[Path, typer.Option(help="CSV of depths and best focus; one line is added.")],
    family: Family = "tag36h11",
    zoom: Annotated[float, typer.Option(help="Held during the sweep, percent.")] = 200.0,
    plot: Annotated[Path | None, typer.Option(help="Picture of the curve, PNG or SVG.")] = None,
) -> None:
    """Sweep the focus over a marker that stands still; fit the focus law once there are three."""
    from tagmetry.cli.lens_curve import measured_pair, told_curve
    from tagmetry.files.lengths import parse_length_m

    measured_pair(camera, parse_length_m(depth), pairs, family, zoom)
    told_curve(pairs, plot)


@app.command()
def bank(
    *,
    camera: Camera,
    board: Annotated[str, typer.Option(help="The board held before the camera.")],
    out: Annotated[Path, typer.Option(help="File of the bank; one that is there goes on.")],
    step: Annotated[float, typer.Option(help="From one focus value to the next.")] = 5.0,
    uncertainty: Annotated[str, typer.Option(help="To be reached at each.")] = "0.3px",
    name: Annotated[str, typer.Option(help="What the camera is called.")] = "camera",
) -> None:
    """Calibrate at every 5 steps of the focus, guided; each is kept at once, Ctrl-C loses none."""
    from tagmetry.cli.lens_bank import calibrated_bank

    calibrated_bank(camera, board, out, step, uncertainty, name)
