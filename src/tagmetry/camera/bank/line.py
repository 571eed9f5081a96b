"""Calibrations along one control, focus or zoom, with the others held."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tagmetry.camera.bank.between import camera_between, carried_errors
from tagmetry.camera.bank.parameters import displacement_px, mean_variance_px2, pixel_grid
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
        own = carried_errors(camera, self._bends_px * (setting - low) * (high - setting))
        return replace(camera, covariance=camera.covariance + own.T @ own)

    def left_out(self, index: int) -> Camera:
        """Return what the others give at the setting of one that is neither first nor last."""
        others = [k for k in range(len(self.settings)) if k != index]
        settings = np.array(self.settings)
        cameras = tuple(self.cameras[k] for k in others)
        return camera_between(cameras, settings[others], self.settings[index])

    @cached_property
    def _bends_px(self) -> Array:
        """The error of interpolating, over (s - low) (high - s), shape (k, n, 2).

        That of a smooth law is bounded by half its second derivative times this product. Leaving
        calibrations out one by one shows it over doubled gaps, mixed with their noise; the share of
        the mean square displacement that their covariances do not explain is taken for it. Their
        squares add up to its variance.
        """
        inside = range(1, len(self.settings) - 1)
        rows = [row for row in map(self._left_out_error, inside) if row is not None]
        pixel_count = len(pixel_grid(self.cameras[0]))
        if not rows:
            return np.zeros((0, pixel_count, 2))
        errors_px = np.array([error_px for error_px, _ in rows])
        seen = float(np.nansum(errors_px**2)) / pixel_count
        explained = sum(by_noise for _, by_noise in rows)
        share = max(0.0, 1.0 - explained / max(seen, 1e-300))
        return np.asarray(np.sqrt(share / len(rows)) * errors_px)

    def _left_out_error(self, index: int) -> tuple[Array, float] | None:
        """Return the displacements of one left out, and their mean square that noise explains.

        None where a covariance is missing.
        """
        camera, predicted = self.cameras[index], self.left_out(index)
        if camera.covariance is None or predicted.covariance is None:
            return None
        low, setting, high = self.settings[index - 1 : index + 2]
        leverage = (setting - low) * (high - setting)
        explained = mean_variance_px2(predicted) + mean_variance_px2(camera)
        return displacement_px(predicted, camera) / leverage, explained / leverage**2

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
