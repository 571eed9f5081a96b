"""The arena as a short video where there is no browser: what the camera sees, and a summary."""

import time
from contextlib import closing
from pathlib import Path

import numpy as np

from tagmetry.camera import Image
from tagmetry.live.show.eye import WatchedEye
from tagmetry.pipeline.arena_twin import CornerEye, TwinArena
from tagmetry.pipeline.arena_twin.ready import ready_scenario
from tagmetry.pipeline.arena_twin.ready.stage import floor, shot
from tagmetry.pipeline.arena_twin.summary import Summary, Summing
from tagmetry.record import draw_overlay, open_overlay
from tagmetry.twin.robots.overhead import OverheadPictures

_PICTURE_S = 0.1


def film(path: Path, name: str, robots: int, seconds: float) -> tuple[Summary, float]:
    """Write what the camera sees of a scenario, ten pictures a second, with the markers found.

    Args:
        path: Of the video, or a folder for pictures.
        name: Of the scenario.
        robots: How many.
        seconds: Simulated time.

    Returns:
        What the run came to, and how long it took, s.

    Raises:
        InputError: There is no such scenario, or the file cannot be written.
    """
    scenario = ready_scenario(name, robots)
    rng = np.random.default_rng(scenario.seed)
    known = [one.robot for one in scenario.robots]
    eye, summing = WatchedEye(CornerEye(known, scenario.view, rng)), Summing()
    began_s, next_s = time.monotonic(), 0.0
    with closing(TwinArena(scenario, eye)) as arena, open_overlay(path) as video:
        pictures = OverheadPictures(floor(scenario.seed), known, shot())
        for moment in arena.run(seconds):
            summing.take(moment)
            look = eye.newest
            if look is not None and look.time_s >= next_s:
                next_s += _PICTURE_S
                pixels = pictures.take(look.Ts_world_robot, rng)
                drawn = draw_overlay(pixels, look.detections)
                video.write(Image(drawn, look.time_s, "capture", source="twin"))
    return summing.summary(), time.monotonic() - began_s
