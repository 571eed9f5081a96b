"""How safely a robot follows another at a delay: margins, overshoot, and the air that is left."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_discrete_lyapunov

from tagmetry.arena.controllers import Course, line_loop_line
from tagmetry.arena.place import Place
from tagmetry.arena.stability.across import Across
from tagmetry.arena.stability.along import LEADER, LENGTH, PLACE, Along
from tagmetry.arena.stability.ideal_drive import ideal_gaps_m
from tagmetry.arena.stability.loop import Loop, Margins, margins
from tagmetry.arena.stability.setting import FollowingSetting
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_WATCHED_S = 5.0  # of a step
_MOST_IMAGES = 100  # that a delay may span: as many states has the loop
_SURE = 3.0  # standard deviations


@dataclass(frozen=True)
class StabilityReport:
    """What is to be expected of a follower.

    Attributes:
        setting: The loop.
        along: Margins along the line to the leader.
        across: Margins of facing it.
        overshoot: By what share of a step of the spring's length the distance goes too far.
        nearest_m: Least distance of an ideal drive, centre to centre.
        farthest_m: Largest.
        gap_sd_m: How much the noise of the places moves the follower, along the line.
        diameter_m: Of both robots.
    """

    setting: FollowingSetting
    along: Margins
    across: Margins
    overshoot: float
    nearest_m: float
    farthest_m: float
    gap_sd_m: float
    diameter_m: float

    @property
    def is_stable(self) -> bool:
        """Whether it comes to rest at the spring's length."""
        return self.along.is_stable and self.across.is_stable

    @property
    def worst_m(self) -> float:
        """How far off the spring's length it gets, with 3 standard deviations of noise."""
        length_m = self.setting.spring.length_m
        off_m = max(self.farthest_m - length_m, length_m - self.nearest_m)
        return off_m + _SURE * self.gap_sd_m

    @property
    def air_m(self) -> float:
        """What is left between the two bodies in the worst moment; negative where they touch."""
        return self.nearest_m - _SURE * self.gap_sd_m - self.diameter_m


def stability(
    setting: FollowingSetting,
    place_sd_m: float = 2e-4,
    diameter_m: float = 0.16,
    course: Course | None = None,
) -> StabilityReport:
    """Return what is to be expected of a follower.

    Args:
        setting: The loop.
        place_sd_m: Noise of each robot's place along the line between them, image by image.
        diameter_m: Of both robots.
        course: That the leader drives; seed 001's line, loop and line when None.

    Raises:
        InputError: The robots would touch at the spring's own length, or a number cannot be used.
    """
    _check(setting, place_sd_m, diameter_m)
    along = margins(lambda more_s: Loop.of(Along(_later(setting, more_s))))
    across = margins(lambda more_s: Loop.of(Across(_later(setting, more_s))))
    loop = Loop.of(Along(setting))
    if not (along.is_stable and across.is_stable):
        inf = float("inf")
        return StabilityReport(setting, along, across, inf, 0.0, inf, inf, diameter_m)
    gaps_m = ideal_gaps_m(setting, course or seed_course(setting.speed_mps))
    return StabilityReport(
        setting,
        along,
        across,
        _overshoot(loop, setting.image_s),
        float(gaps_m.min()),
        float(gaps_m.max()),
        _gap_sd_m(loop, place_sd_m),
        diameter_m,
    )


def stability_by_delay(
    setting: FollowingSetting,
    delays_s: Sequence[float],
    place_sd_m: float = 2e-4,
    diameter_m: float = 0.16,
) -> list[StabilityReport]:
    """Return one report for each delay that the controller is told."""
    settings = [replace(setting, delay_s=delay_s) for delay_s in delays_s]
    return [stability(one, place_sd_m, diameter_m) for one in settings]


def seed_course(speed_mps: float) -> Course:
    """Return seed 001's line, loop and line at a speed, from rest to rest."""
    path = line_loop_line(Place(0.0, 0.0, 0.0))
    return Course(path.start, path.arcs, speed_mps, start_s=1.0)


def _later(setting: FollowingSetting, more_s: float) -> FollowingSetting:
    return replace(setting, untold_s=setting.untold_s + more_s)


def _overshoot(loop: Loop, image_s: float) -> float:
    """Return by how much the distance overshoots a step of the spring's length."""
    step, own = loop.driven()[:, LENGTH], loop.closed()
    state, furthest = np.zeros(len(own)), 0.0
    for _ in range(round(_WATCHED_S / image_s)):
        state = own @ state + step
        furthest = max(furthest, -float(state[PLACE]))
    return max(furthest - 1, 0.0)


def _gap_sd_m(loop: Loop, place_sd_m: float) -> float:
    """Return how much noise of both places moves the follower: the loop's stationary covariance."""
    noise: Array = np.sqrt(2) * place_sd_m * loop.driven()[:, LEADER]
    covariance = solve_discrete_lyapunov(loop.closed(), np.outer(noise, noise))
    return float(np.sqrt(covariance[PLACE, PLACE]))


def _check(setting: FollowingSetting, place_sd_m: float, diameter_m: float) -> None:
    spanned = (setting.delay_s + setting.untold_s) / setting.image_s
    if spanned > _MOST_IMAGES:
        raise InputError(f"a delay spans at most {_MOST_IMAGES} images, got {spanned:.0f}")
    if not 0 <= place_sd_m < 1:
        raise InputError(f"place_sd_m must be 0 to 1 m, got {place_sd_m}")
    if not 0 < diameter_m < setting.spring.length_m:
        raise InputError(
            f"robots of {diameter_m} m across touch at a distance of {setting.spring.length_m} m "
            "from centre to centre; give a longer spring"
        )
