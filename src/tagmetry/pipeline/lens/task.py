"""What is looked for, with what, and how well it is to be known."""

from dataclasses import dataclass
from time import process_time
from typing import Protocol

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lens import (
    LensSetting,
    MarkerKind,
    Measured,
    ZoomLens,
    marker_blur_px,
    measured,
)
from tagmetry.pipeline.lens.drive import Taken
from tagmetry.pipeline.lens.step import LensStep, Phase

NO_MARKER = "no marker"
_WANTED_TURN_RAD = float(np.radians(0.3))


class Finder(Protocol):
    """Anything that finds markers in an image: `tagmetry.detect.Detector`, or your own."""

    def detect(self, image: AnyPixels, camera: Camera | None = None) -> tuple[Detection, ...]:
        """Return the markers in an image."""


@dataclass(frozen=True, eq=False)
class LensTask:
    """What is to be measured.

    Attributes:
        lens: What is known of the camera.
        finder: Finds markers.
        marker: Their size.
        marker_id: Which one; any, where None.
        wanted_share: Standard deviation of the depth to be reached, as a share of it.
        wanted_turn_rad: Standard deviation of the turn to be reached, by averaging where one
            image does not.
        most_averaged: Images that are averaged for that at most.
        most_images: After how many images without the marker the search is given up.
    """

    lens: ZoomLens
    finder: Finder
    marker: MarkerKind
    marker_id: int | None = None
    wanted_share: float = 1e-3
    wanted_turn_rad: float = _WANTED_TURN_RAD
    most_averaged: int = 8
    most_images: int = 150

    def __post_init__(self) -> None:
        if not self.wanted_share > 0:
            raise InputError(f"wanted_share must be positive, got {self.wanted_share}")
        if not self.wanted_turn_rad > 0:
            raise InputError(f"wanted_turn_rad must be positive, got {self.wanted_turn_rad}")
        for name in ("most_averaged", "most_images"):
            if getattr(self, name) < 1:
                raise InputError(f"{name} must be 1 or more, got {getattr(self, name)}")

    def look(self, taken: Taken, phase: Phase) -> LensStep:
        """Return what an image shows of the marker, with the pose at the setting in effect."""
        began_s = process_time()
        image = taken.image
        camera = self.lens.camera_at(taken.setting)
        seen = self.finder.detect(image.pixels, camera)
        wanted = [one for one in seen if self.marker_id in (None, one.id)]
        found, reason = None, _why_not(wanted)
        if not reason:
            nearest = max(wanted, key=lambda one: one.side_px)
            found = self._measured(image.pixels, nearest, taken.setting)
            reason = "" if found else f"the corners of id {nearest.id} are no marker's"
        return LensStep(
            phase,
            image,
            taken.setting,
            taken.is_settled,
            found,
            busy_s=process_time() - began_s,
            reason=reason,
        )

    def _measured(
        self, pixels: AnyPixels, detection: Detection, setting: LensSetting
    ) -> Measured | None:
        blur_px = marker_blur_px(pixels, detection, self.marker.side_cells)
        return measured(detection, self.lens, self.marker, setting, blur_px)


def _why_not(wanted: list[Detection]) -> str:
    if not wanted:
        return NO_MARKER
    twice = [one.id for one in wanted if one.is_duplicate]
    return f"id {twice[0]} is there more than once; which is meant cannot be told" if twice else ""
