"""`tagmetry compare`: how far a trajectory is from the true one."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from tagmetry.cli.answer import answer
from tagmetry.cli.options import Json, check_png

if TYPE_CHECKING:
    from tagmetry.localize.trajectory import Comparison, Spread


def compare(
    *,
    estimated: Annotated[Path, typer.Argument(help="Trajectory that is judged: .tum.")],
    true: Annotated[Path, typer.Argument(help="Trajectory that it is judged by: .tum.")],
    align: Annotated[
        Literal["none", "path", "rig"],
        typer.Option(
            help="none: both are of one thing in one world. path: turn and shift the first so that "
            "the ways lie on one another (Horn, without a scale). rig: of two things fixed to each "
            "other, such as a camera and what motion capture sees of it."
        ),
    ] = "none",
    gap: Annotated[
        float,
        typer.Option(min=0.0, help="Widest gap, s, in which the true one is interpolated."),
    ] = 0.1,
    step: Annotated[
        float,
        typer.Option(min=0.0, help="The relative error's time, s; 0: from each pose to the next."),
    ] = 0.0,
    picture: Annotated[
        Path | None, typer.Option(help="Both ways and the errors over time: .png.")
    ] = None,
    json: Json = False,
) -> None:
    """Say how far a trajectory is from the true one: absolute and relative error."""
    from tagmetry.files.trajectories import load_trajectory
    from tagmetry.localize.trajectory import compare as compared

    check_png(picture)
    found = compared(
        load_trajectory(estimated), load_trajectory(true), align=align, gap_s=gap, step_s=step
    )
    if picture is not None:
        _draw(picture, found)
    answer(json=json, table=lambda: _table(found), lines=lambda: _lines(found))


def _lines(found: "Comparison") -> list[str]:
    both = found.both
    unmatched = f", {both.unmatched} without a true one" if both.unmatched else ""
    rows = [
        f"{name:22}" + "".join(f"{one:10.3f}" for one in _numbers(spread))
        for name, spread in _spreads(found).items()
    ]
    return [
        f"{len(both.true.times_s)} poses over {both.true.length_m:.3f} m{unmatched}",
        f"{'':22}{'rms':>10}{'mean':>10}{'median':>10}{'largest':>10}",
        *rows,
    ]


def _numbers(spread: "Spread") -> tuple[float, ...]:
    return spread.rms, spread.mean, spread.median, spread.largest


def _table(found: "Comparison") -> dict[str, Any]:
    from dataclasses import asdict
    from math import isfinite

    spreads = {
        name: {key: value if isfinite(value) else None for key, value in asdict(one).items()}
        for name, one in _spreads(found).items()
    }
    return {
        "poses": len(found.both.true.times_s),
        "unmatched": found.both.unmatched,
        "length_m": found.both.true.length_m,
        "step_s": found.step_s,
        **spreads,
    }


def _spreads(found: "Comparison") -> "dict[str, Spread]":
    import numpy as np

    from tagmetry.localize.trajectory import Spread

    return {
        "absolute_mm": Spread.of(1000 * found.absolute_m),
        "absolute_deg": Spread.of(np.degrees(found.absolute_rad)),
        "relative_mm": Spread.of(1000 * found.relative_m),
        "relative_deg": Spread.of(np.degrees(found.relative_rad)),
    }


def _draw(path: Path, found: "Comparison") -> None:
    from tagmetry.files import write_atomically
    from tagmetry.record.trajectory_drawing import comparison_picture

    write_atomically(path, comparison_picture(found))
