"""Calibrations along one control, focus or zoom, with the others held."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tagmetry.camera.bank.bends import Bend, bend_at, bend_between_two, unexplained_share
from tagmetry.camera.bank.between import camera_between, carried_errors
from tagmetry.camera.bank.parameters import pixel_grid
from tagmetry.camera.model import Camera
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array


@dataclass(frozen=True, eq=False)
class Line:
    """Cameras of one image size at ascending settings of one control.

    Attributes:
        control: What the control is called.
        settings: Strictly ascending.
        cameras: One for each, with equally many parameters.
    """

    control: str
    settings: tuple[float, ...]
    cameras: tuple[Camera, ...]

    def camera_at(self, setting: float) -> Camera:
        """Return the camera at a setting, its covariance with the error of interpolating."""
        self._check(setting)
        if setting in self.settings:
            return self.cameras[self.settings.index(setting)]
        camera = camera_between(self.cameras, np.array(self.settings), setting)
        low, high = self._around(setting)
        camera = replace(camera, provenance=f"between {self.control} {low:g} and {high:g}")
        if camera.covariance is None:
            return camera
        own = carried_errors(camera, self._bends_px(setting) * (setting - low) * (high - setting))
        return replace(camera, covariance=camera.covariance + own.T @ own)

    def left_out(self, index: int) -> Camera:
        """Return what the others give at the setting of one that is neither first nor last."""
        others = [k for k in range(len(self.settings)) if k != index]
        settings = np.array(self.settings)
        cameras = tuple(self.cameras[k] for k in others)
        return camera_between(cameras, settings[others], self.settings[index])

    def _bends_px(self, setting: float) -> Array:
        """Return the error of interpolating over its leverage, shape (k, n, 2).

        The k squares add up to its variance. It is what leaving out the two neighbours shows over
        doubled gaps, less the share that noise explains in the whole line; where that cannot be
        known of them, what all others show.
        """
        right = int(np.searchsorted(self.settings, setting))
        bends = self._bends
        near = [bends[k] for k in (right - 1, right) if k in bends] or list(bends.values())
        if not near:
            return np.zeros((0, len(pixel_grid(self.cameras[0])), 2))
        errors_px = np.array([bend.error_px for bend in near])
        return np.asarray(np.sqrt(unexplained_share(bends.values()) / len(near)) * errors_px)

    @cached_property
    def _bends(self) -> dict[int, Bend]:
        """What interpolating costs at each calibration where that is known, by its number."""
        if len(self.settings) == 2:
            gap = self.settings[1] - self.settings[0]
            found = {0: bend_between_two(self.cameras[0], self.cameras[1], gap)}
        else:
            found = {k: self._bend_at(k) for k in range(1, len(self.settings) - 1)}
        return {index: bend for index, bend in found.items() if bend is not None}

    def _bend_at(self, index: int) -> Bend | None:
        low, setting, high = self.settings[index - 1 : index + 2]
        leverage = (setting - low) * (high - setting)
        return bend_at(self.cameras[index], self.left_out(index), leverage)

    def _around(self, setting: float) -> tuple[float, float]:
        right = int(np.searchsorted(self.settings, setting))
        return self.settings[right - 1], self.settings[right]

    def _check(self, setting: float) -> None:
        low, high = self.settings[0], self.settings[-1]
        if not low <= setting <= high:
            raise InputError(
                f"{self.control} {setting:g} lies outside {low:g} to {high:g}, where the bank has "
                "calibrations; stay within, or calibrate there and add it"
            )
