"""Do the images show what was commanded? A control that sticks, or is late, shows in the marker.

Zoom: the marker grows with it. Focus: where the marker should be sharp it is not.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.lens import LensSetting, Measured, ZoomLens

_TELLING_ZOOM = 1.15
_NEARLY_ALL, _NEARLY_NONE = 0.25, 0.4  # of the growing, by how much it may be missed
_MORE, _LESS = 1.33, 1.2
_JUMP = 1.25  # of a marker's size, from an image to the next
_AROUND = 2.0  # of a marker's side, the room that it needs
_BLURRED_PX = 2.0  # standard deviation beyond what the setting should leave


@dataclass(frozen=True)
class Disobedience:
    """What a control should show and does not.

    Attributes:
        control: Its name.
        told: What was seen, in words.
    """

    control: str
    told: str


def disobedience(lens: ZoomLens, before: Measured | None, now: Measured) -> Disobedience | None:
    """Return which control does not show in an image that is thought to be settled.

    Args:
        lens: The camera.
        before: The last measurement at another setting, of a marker that hardly moved since.
        now: This one.
    """
    if before is not None and (told := _zoom_did_not(before, now)):
        return Disobedience("zoom", told)
    expected_px = _expected_blur_px(lens, now)
    if now.blur_px > 2 * expected_px + _BLURRED_PX:
        return Disobedience(
            "focus",
            f"at {now.setting.focus:g} the marker should be sharp, and is blurred by "
            f"{now.blur_px:.1f} px",
        )
    return None


def _expected_blur_px(lens: ZoomLens, now: Measured) -> float:
    """Return the blur of the marker's nearest or farthest edge, whichever is larger."""
    deep_m = now.pose.size_m / 2 * float(np.sin(now.tilt_rad))
    ends_m = (max(now.depth_m - deep_m, now.depth_m / 2), now.depth_m + deep_m)
    return max(lens.blur_of_depth_px(now.setting, depth_m) for depth_m in ends_m) / 4


def shows_zoom(before: Measured, now: Measured) -> bool | None:
    """Say whether a marker grew with the zoom between two images; None where that is not clear.

    One that was blurred looked smaller than it is, so only growing about as expected is a proof.
    One that grew otherwise, by another command that was late or by moving, tells nothing.
    """
    if not tells(before.setting, now.setting):
        return None
    ratio = now.setting.zoom_percent / before.setting.zoom_percent
    grown = float(np.log(now.detection.side_px / before.detection.side_px) / np.log(ratio))
    return True if abs(grown - 1) < _NEARLY_ALL else False if abs(grown) < _NEARLY_NONE else None


def jumps(before: Measured, now: Measured) -> bool:
    """Say whether a marker is another size in the next image, though nothing was commanded."""
    grew = now.detection.side_px / before.detection.side_px
    return before.setting == now.setting and max(grew, 1 / grew) > _JUMP


def tells(before: LensSetting, now: LensSetting) -> bool:
    """Say whether two zooms are so different that a marker's size tells them apart."""
    ratio = now.zoom_percent / before.zoom_percent
    return max(ratio, 1 / ratio) >= _TELLING_ZOOM


def telling_zoom(lens: ZoomLens, now: Measured) -> LensSetting:
    """Return a setting whose zoom tells whether it shows: more, where marker and control have room.

    Less of it is no more than tells, so that small and oblique markers are not lost.
    """
    zoom, focus = now.setting.zoom_percent, now.setting.focus
    more = LensSetting(lens.zoom.nearest(zoom * _MORE), focus)
    has_room = _MORE * _AROUND * now.detection.side_px < min(lens.size_px)
    if has_room and tells(now.setting, more):
        return more
    return LensSetting(lens.zoom.nearest(zoom / _LESS), focus)


def _zoom_did_not(before: Measured, now: Measured) -> str:
    if shows_zoom(before, now) is not False:
        return ""
    grew = now.detection.side_px / before.detection.side_px
    return f"from {_text(before.setting)} to {_text(now.setting)} the marker grew {grew:.2f} times"


def _text(setting: LensSetting) -> str:
    return f"{setting.zoom_percent:g} percent"
