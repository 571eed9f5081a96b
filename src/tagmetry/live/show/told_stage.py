"""What the page is told of all that robots are among, and of what can be set."""

from collections.abc import Iterable

from tagmetry.arena import Disc, Wall
from tagmetry.arena.safety import Fence
from tagmetry.live.messages import LiveParameter, Stage
from tagmetry.live.show.stage import Performance
from tagmetry.live.show.steered import Steered, parameters_by_name


def told_stage(show: Performance) -> Stage:
    """Return what robots are among."""
    scenario = show.arena.scenario
    fence = scenario.rules.fence or _fence_of(show.steered.values())
    return Stage(
        show.name,
        scenario.sensor.range_m,
        fence.corners_m if fence is not None else (),
        tuple((*one.center_m, one.radius_m) for one in scenario.obstacles if isinstance(one, Disc)),
        tuple((*one.start_m, *one.end_m) for one in scenario.obstacles if isinstance(one, Wall)),
        tuple(
            LiveParameter(one.name, one.value, one.least, one.most, one.meaning)
            for one in parameters_by_name(show.steered.values()).values()
        ),
    )


def _fence_of(steered: Iterable[Steered]) -> Fence | None:
    """Return the fence of the first controller that keeps one."""
    return next((one.fence for one in steered if one.fence is not None), None)
