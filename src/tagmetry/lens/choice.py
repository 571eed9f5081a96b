"""Which setting comes next? The one that promises the most, if it promises enough more.

The focus follows from the depth: a little before it, so that edges are as wide as pixels. The zoom
is the least (which shows the most of the scene) among those that promise nearly the least
uncertainty of the depth, leave the marker large enough to be read, and keep it within the image. A
setting is kept while it is nearly as good, so that the controls do not hunt.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lens.accuracy import SOFT_PX, prospect
from tagmetry.lens.readable import MarkerKind, enough_zoom, readable_share
from tagmetry.lens.setting import LensSetting
from tagmetry.lens.zoom_lens import ZoomLens

_NEARLY = 1.05  # of the least uncertainty
_WORTH_IT = 1.25  # by which a new setting must promise less uncertainty than the present one
_SHARP_ENOUGH = 0.12  # of the depth of reading, that the focus may be off
_MARGIN = 0.9  # of half the image, that a marker's corners stay within
_ZOOMS = 17


@dataclass(frozen=True, eq=False)
class Whereabouts:
    """Where a marker is expected.

    Attributes:
        p_camera: Its centre, shape (3,), m.
        tilt_rad: Between the view and its normal.
    """

    p_camera: Array
    tilt_rad: float = 0.0

    @property
    def depth_m(self) -> float:
        """Its depth."""
        return float(self.p_camera[2])


def best_setting(lens: ZoomLens, marker: MarkerKind, at: Whereabouts) -> LensSetting:
    """Return the setting that promises the most for a marker, however the camera is set now."""
    zooms_percent = _zooms_percent(lens, marker, at)
    candidates = [lens.softly_at(at.depth_m, zoom, SOFT_PX) for zoom in zooms_percent]
    shares = [
        prospect(lens, marker, at.depth_m, one, at.tilt_rad).depth_share for one in candidates
    ]
    good = [
        one for one, share in zip(candidates, shares, strict=True) if share <= _NEARLY * min(shares)
    ]
    return min(good, key=lambda one: one.zoom_percent)


def next_setting(
    lens: ZoomLens, marker: MarkerKind, at: Whereabouts, now: LensSetting
) -> LensSetting:
    """Return the best setting, or the present one where it is nearly as good."""
    best = best_setting(lens, marker, at)
    return now if _is_good_enough(lens, marker, at, now, best) else best


def _is_good_enough(
    lens: ZoomLens, marker: MarkerKind, at: Whereabouts, now: LensSetting, best: LensSetting
) -> bool:
    off = at.depth_m * abs(1 / lens.law.depth_m(best.focus) - 1 / lens.law.depth_m(now.focus))
    if off > _SHARP_ENOUGH * readable_share(lens, marker) and now.focus != best.focus:
        return False
    least, most = _zoom_limits(lens, marker, at)
    if not least <= now.magnification <= most and now.zoom_percent != best.zoom_percent:
        return False
    tilt_rad = at.tilt_rad
    has = prospect(lens, marker, at.depth_m, now, tilt_rad).depth_share
    could = prospect(lens, marker, at.depth_m, best, tilt_rad).depth_share
    return has <= _WORTH_IT * could


def _zooms_percent(lens: ZoomLens, marker: MarkerKind, at: Whereabouts) -> list[float]:
    least, most = _zoom_limits(lens, marker, at)
    tried = [*np.geomspace(least, most, _ZOOMS).tolist()]
    native = lens.native_percent / 100
    return [100 * zoom for zoom in (*tried, native) if least <= zoom <= most] or [100 * least]


def _zoom_limits(lens: ZoomLens, marker: MarkerKind, at: Whereabouts) -> tuple[float, float]:
    """Return the least and the greatest magnification of use."""
    low, high = lens.zoom.least / 100, lens.zoom.most / 100
    most = float(np.clip(_fitting(lens, marker, at), low, high))
    least = float(np.clip(enough_zoom(lens, marker, at.depth_m, at.tilt_rad), low, most))
    return least, most


def _fitting(lens: ZoomLens, marker: MarkerKind, at: Whereabouts) -> float:
    """Return the magnification that brings the marker's outermost point to the image's margin."""
    offset_m = np.abs(at.p_camera[:2]) + marker.size_m / np.sqrt(2)
    reach_px = lens.focal_px() * offset_m / at.depth_m
    return float(_MARGIN * np.min(np.array(lens.size_px) / 2 / reach_px))
