"""What calibrations along the focus say of themselves: their gaps, and what each is worth."""

from collections.abc import Iterator

import numpy as np

from tagmetry.camera.bank.line import Line
from tagmetry.camera.bank.parameters import worst_displacement_px
from tagmetry.camera.bank.report import Gap, LeftOut
from tagmetry.camera.model import Camera


def gaps_of(line: Line, step: float) -> Iterator[Gap]:
    """Give what lies between neighbours that are farther apart than a step."""
    first = line.cameras[0]
    for low, high in zip(line.settings, line.settings[1:], strict=False):
        if high - low > step * (1 + 1e-9):
            sd_percent = _focal_sd_percent(line.camera_at((low + high) / 2))
            yield Gap(*first.size_px, first.zoom, low, high, sd_percent)


def left_out_of(line: Line) -> Iterator[LeftOut]:
    """Compare each calibration, but for the first and last, with what the others predict."""
    for index in range(1, len(line.settings) - 1):
        yield _left_out(line, index)


def _left_out(line: Line, index: int) -> LeftOut:
    camera, predicted = line.cameras[index], line.left_out(index)
    ratio = np.array(predicted.focal_px) / camera.focal_px
    shift_px = np.array(predicted.center_px) - camera.center_px
    return LeftOut(
        *camera.size_px,
        camera.zoom,
        line.settings[index],
        float(100 * (ratio.mean() - 1)),
        float(np.linalg.norm(shift_px)),
        worst_displacement_px(predicted, camera),
    )


def _focal_sd_percent(camera: Camera) -> float | None:
    if camera.covariance is None:
        return None
    return float(100 * np.sqrt(camera.covariance[0, 0]) / camera.focal_px[0])
