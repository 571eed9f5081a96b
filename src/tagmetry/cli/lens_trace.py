"""The live trace of a driven lens: one line of text or JSON for each image."""

import json
from collections.abc import Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import typer

if TYPE_CHECKING:
    from tagmetry.pipeline.lens import LensStep

_TELLING = 0.01  # a probability worth a word


def told(steps: "Iterable[LensStep]", out: Path | None, *, json_: bool) -> "LensStep | None":
    """Tell every step, write it where that was asked for, and return the last one.

    Args:
        steps: As they come.
        out: A file of JSON lines, written as the images come.
        json_: Print JSON instead of text.
    """
    last = None
    with ExitStack() as ending:
        file = ending.enter_context(out.open("w", encoding="utf-8")) if out else None
        for last in steps:
            line = json.dumps(last.table(), separators=(",", ":"))
            if file is not None:
                file.write(line + "\n")
                file.flush()
            typer.echo(line if json_ else step_line(last))
    return last


def step_line(step: "LensStep") -> str:
    """Return one image as a line for people."""
    setting = step.setting
    head = (
        f"{step.image.sequence:>5} {step.phase:<9} zoom {setting.zoom_percent:3.0f} "
        f"focus {setting.focus:5.1f} {'' if step.is_settled else '(moving) ':<9}"
    )
    found = step.found
    if found is None:
        return head + step.reason
    tail = " final" if step.is_final else ""
    told = f"; {step.reason}" if step.reason else ""
    return (
        f"{head}id {found.detection.id} depth {1000 * found.depth_m:8.2f} mm "
        f"± {1000 * found.depth_sd_m:.2f}, turn ± {np.degrees(found.turn_sd_rad):.2f} degrees"
        f"{_other_pose(found.pose.ambiguity)}{tail}{told}"
    )


def _other_pose(ambiguity: float) -> str:
    """Say how probable the other of a flat marker's two poses is, where that counts."""
    return f" (other pose {100 * ambiguity:.0f} %)" if ambiguity > _TELLING else ""
