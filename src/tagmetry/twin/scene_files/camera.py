"""The camera of a scene file: where it is, its lens, its shutter, its sensor.

camera:
  size_px: [1280, 720]
  field_of_view_deg: 60
  at: {translation_m: [0, -2, 1], looking_at_m: [0, 0, 1]}
  optics: {blur_px: 0.6, vignetting: 0.5}
  sensor: {full_well_e: 10000, read_noise_e: 6}
"""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.errors import InputError
from tagmetry.files import load_camera
from tagmetry.files.checked import OwnFileModel
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.scene_files.fields import Pair, Positive, SizePx
from tagmetry.twin.scene_files.imaging import OpticsTable, SensorTable, ShutterTable, ZoomTable
from tagmetry.twin.scene_files.place import MovingPlace, WaypointPath, path_of

_Angle = Annotated[float, Field(gt=0, lt=175)]


class _Lens(OwnFileModel):
    """Distortion, as OpenCV counts its coefficients."""

    kind: Literal["brown", "fisheye"] = "brown"
    coefficients: list[float]

    def lens(self) -> Lens:
        """Return the lens."""
        given = tuple(map(float, self.coefficients))
        return FisheyeLens(given) if self.kind == "fisheye" else BrownLens(given)


class CameraTable(OwnFileModel):
    """The whole camera; its intrinsics from a file, or from size and focal length."""

    file: str | None = None
    size_px: SizePx | None = None
    focal_px: Positive | None = None
    field_of_view_deg: _Angle | None = None
    center_px: Pair | None = None
    lens: _Lens | None = None
    at: MovingPlace | None = None
    path: WaypointPath | None = None
    optics: OpticsTable = OpticsTable()
    shutter: ShutterTable = ShutterTable()
    sensor: SensorTable = SensorTable()
    zoom: ZoomTable = ZoomTable()
    brightness: Positive = 0.85

    def shot(self) -> Shot:
        """Return the camera about to take its first picture."""
        return Shot(
            self._camera(),
            path_of(self.at, self.path, is_camera=True),
            optics=self.optics.optics(),
            shutter=self.shutter.shutter(),
            sensor=self.sensor.sensor(),
            zoom=self.zoom.zoom(),
            brightness=self.brightness,
        )

    def _camera(self) -> Camera:
        inline = (self.size_px, self.focal_px, self.field_of_view_deg, self.center_px, self.lens)
        if self.file is not None:
            if any(one is not None for one in inline):
                raise InputError("give the camera's `file`, or its size_px and so on, not both")
            return load_camera(self.file)
        if self.size_px is None:
            raise InputError("expected size_px, as [1280, 720], or the `file` of a camera")
        width_px, height_px = self.size_px
        center_px = self.center_px or [(width_px - 1) / 2, (height_px - 1) / 2]
        lens = self.lens.lens() if self.lens is not None else BrownLens()
        focal_px = (self._focal_px(width_px),) * 2
        return Camera(width_px, height_px, focal_px, (center_px[0], center_px[1]), lens)

    def _focal_px(self, width_px: int) -> float:
        """Return the focal length, given or from the field of view across, without distortion."""
        if (self.focal_px is None) == (self.field_of_view_deg is None):
            raise InputError("give one of focal_px and field_of_view_deg")
        if self.focal_px is not None:
            return self.focal_px
        half_rad = np.radians(self.field_of_view_deg or 0.0) / 2
        if self.lens is not None and self.lens.kind == "fisheye":
            return float(width_px / 2 / half_rad)
        return float(width_px / 2 / np.tan(half_rad))
