"""In which order settings are tried until a marker is found.

`seed_scan` is the paper's: zoom at its most, focus from near to far in steps of 15. `quick_scan`
takes focus values whose depths of reading overlap, and no more zoom than the marker's size asks
for, so that more of the scene is seen: three settings instead of eleven for a 10 mm marker between
0.05 and 1.05 m. The same follow on the motor's way back with twice the zoom, for oblique markers.
"""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.lens.readable import (
    DepthRange,
    MarkerKind,
    depth_of_reading,
    largest_zoom,
    readable_share,
    widest_zoom_percent,
)
from tagmetry.lens.setting import LensSetting
from tagmetry.lens.zoom_lens import ZoomLens

_OVERLAP = 0.85  # of the depth of reading that is counted on
_MOST_SETTINGS = 200


def seed_scan(lens: ZoomLens, step: float = 15.0) -> tuple[LensSetting, ...]:
    """Return the settings of steps (1a) to (1d): 500 and 150, 135, ... 0 on the paper's camera.

    Reference: seed 000, section 3.1; near is where the focus value is greatest.
    """
    if not step > 0:
        raise InputError(f"the step of a scan must be positive, got {step}")
    count = int((lens.focus.most - lens.focus.least) / step + 1e-9) + 1
    return tuple(LensSetting(lens.zoom.most, lens.focus.most - step * n) for n in range(count))


def quick_scan(
    lens: ZoomLens, marker: MarkerKind, start_focus: float | None = None
) -> tuple[LensSetting, ...]:
    """Return settings that leave no depth out, beginning at the end nearer to the motor.

    Args:
        lens: The camera.
        marker: What is looked for.
        start_focus: Where the motor is.

    Raises:
        InputError: The marker is so small for the aperture that no scan of use exists.
    """
    share = _OVERLAP * readable_share(lens, marker)
    focused_m = [lens.farthest_m / (1 + share)]
    while focused_m[-1] * (1 - share) > lens.nearest_m:
        focused_m.append(focused_m[-1] * (1 - share) / (1 + share))
        if len(focused_m) > _MOST_SETTINGS:
            raise InputError(
                f"a marker with cells of {1000 * marker.cell_m:g} mm is sharp in so little depth "
                "that it takes hundreds of images to find; take a larger one, or a smaller range"
            )
    settings = [_setting(lens, marker, depth_m, share) for depth_m in focused_m]
    if start_focus is not None:
        settings.sort(key=lambda one: one.focus)
        nearer_first = abs(settings[-1].focus - start_focus) < abs(settings[0].focus - start_focus)
        settings = settings[::-1] if nearer_first else settings
    closer = [_closer(lens, marker, one) for one in reversed(settings)]
    return tuple(dict.fromkeys((*settings, *closer)))


def search_around(
    lens: ZoomLens, marker: MarkerKind, depth_m: float, doubt_m: float
) -> tuple[LensSetting, ...]:
    """Return settings to find a marker again that was, or should be, at a depth.

    The most probable depth comes first, then those around it, then all the others: nothing that
    `quick_scan` finds is missed.

    Args:
        lens: The camera.
        marker: What is looked for.
        depth_m: Where it should be: its last depth carried on, or what is known of a robot's arm.
        doubt_m: By how much it may be off.
    """
    if not (np.isfinite(depth_m) and depth_m > 0 and np.isfinite(doubt_m) and doubt_m >= 0):
        raise InputError(f"expected a depth and a doubt in metres, got {depth_m} and {doubt_m}")
    least_m = float(np.clip(depth_m - doubt_m, lens.nearest_m, lens.farthest_m))
    most_m = float(np.clip(depth_m + doubt_m, lens.nearest_m, lens.farthest_m))
    first = lens.sharp_at(depth_m, widest_zoom_percent(lens, marker, DepthRange(least_m, most_m)))
    rest = sorted(quick_scan(lens, marker), key=lambda one: abs(one.focus - first.focus))
    return tuple(dict.fromkeys((first, *rest)))


def _closer(lens: ZoomLens, marker: MarkerKind, setting: LensSetting) -> LensSetting:
    """Return a setting with twice the zoom, where a marker in focus stays within the image."""
    allowed = largest_zoom(lens, marker, lens.law.depth_m(setting.focus))
    zoom = max(min(2 * setting.magnification, allowed), setting.magnification)
    return LensSetting(lens.zoom.nearest(100 * zoom), setting.focus)


def _setting(lens: ZoomLens, marker: MarkerKind, focused_m: float, share: float) -> LensSetting:
    focus = lens.focus.nearest(lens.law.value(focused_m))
    depths = depth_of_reading(lens, marker, focus)
    used = DepthRange(
        max(depths.near_m, focused_m * (1 - share), lens.nearest_m),
        min(focused_m * (1 + share), lens.farthest_m),
    )
    return LensSetting(widest_zoom_percent(lens, marker, used), focus)
