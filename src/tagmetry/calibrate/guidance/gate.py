"""Is a view worth taking: does the board stand still, is it sharp, is it not there already?"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.targets import ViewQuality
from tagmetry.calibrate.view import BoardView
from tagmetry.errors import InputError
from tagmetry.geometry import Array


@dataclass(frozen=True)
class GateLimits:
    """What a view must keep to be taken.

    Attributes:
        motion_px: Largest median motion of its corners since the image before.
        pause_s: Longest time since that image; after more, stillness is unknown.
        apart_share: Least distance to every view taken, root mean square over the corners, as a
            share of the image's diagonal.
        blur_share: Largest blur as a share of the distance between corners.
    """

    motion_px: float = 0.5
    pause_s: float = 1.0
    apart_share: float = 0.03
    blur_share: float = 0.1

    def __post_init__(self) -> None:
        for name in ("motion_px", "pause_s", "apart_share", "blur_share"):
            if not getattr(self, name) >= 0:
                raise InputError(f"{name} must not be negative, got {getattr(self, name)}")


def is_unsteady(
    view: BoardView, before: BoardView | None, passed_s: float, limits: GateLimits
) -> str | None:
    """Return why a board does not count as still, in words; None when it does.

    Args:
        view: What is seen now.
        before: What was seen in the image before.
        passed_s: Time between the two.
        limits: How still it must be.
    """
    if before is None or not 0 <= passed_s <= limits.pause_s:
        return "seen once; hold still for one more image"
    moved_px = median_motion_px(view, before)
    if not moved_px <= limits.motion_px:
        return f"moving: {moved_px:.1f} px since the image before; hold still"
    return None


def is_blurred(quality: ViewQuality | None, limits: GateLimits) -> str | None:
    """Return why a view is not sharp enough, in words; None when it is, or nobody measured it."""
    if quality is None or quality.blur_px <= limits.blur_share * quality.spacing_px:
        return None
    return (
        f"blurred by {quality.blur_px:.1f} px where corners are {quality.spacing_px:.0f} px apart; "
        "focus, or come closer"
    )


def is_repeated(view: BoardView, taken: Sequence[BoardView], limits: GateLimits) -> str | None:
    """Return which view is nearly the same, in words; None when none is."""
    least_px = limits.apart_share * float(np.hypot(*view.size_px))
    apart_px = [distance_px(view, other) for other in taken]
    if not apart_px or min(apart_px) >= least_px:
        return None
    return (
        f"only {min(apart_px):.0f} px from view {int(np.argmin(apart_px)) + 1}, which is taken "
        f"already; move the board by {least_px:.0f} px or tilt it"
    )


def median_motion_px(view: BoardView, other: BoardView) -> float:
    """Return the median distance of common corners; infinity where there are none."""
    apart = _apart_px(view, other)
    return float(np.median(apart)) if apart.size else np.inf


def distance_px(view: BoardView, other: BoardView) -> float:
    """Return the root mean square distance of common corners; infinity where there are none."""
    apart = _apart_px(view, other)
    return float(np.sqrt((apart**2).mean())) if apart.size else np.inf


def _apart_px(view: BoardView, other: BoardView) -> Array:
    _, mine, its = np.intersect1d(view.points, other.points, return_indices=True)
    return np.asarray(np.linalg.norm(view.corners_px[mine] - other.corners_px[its], axis=1))
