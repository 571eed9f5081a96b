"""Images of a marker at rest, taken at one setting, as one measurement.

The mean of n images has an n-th of the noise's variance. What no noise tells, as the calibration,
is the same in each of them and stays: some images are worth their time, many are not.
"""

from dataclasses import replace

from tagmetry.errors import InputError
from tagmetry.lens.measured import Measured, measured
from tagmetry.lens.readable import MarkerKind
from tagmetry.lens.zoom_lens import ZoomLens


def together(before: Measured, now: Measured, lens: ZoomLens, marker: MarkerKind) -> Measured:
    """Return the mean of two measurements, each of one image or more.

    Corners are averaged, not poses: near the frontal view errors of the turn are far from normal.

    Args:
        before: The images up to now.
        now: Those that are added, of the same marker at the same place; its blur is kept.
        lens: The camera.
        marker: Its size.

    Raises:
        InputError: They were taken at different settings.
    """
    if before.setting != now.setting:
        raise InputError(
            f"only images of one setting have a mean, got {before.setting} and {now.setting}"
        )
    images = before.images + now.images
    old, new = before.images / images, now.images / images
    seen = replace(
        now.seen,
        corners_px=old * before.seen.corners_px + new * now.seen.corners_px,
        corners_cov_px2=old**2 * before.seen.corners_cov_px2 + new**2 * now.seen.corners_cov_px2,
    )
    mean = measured(seen, lens, marker, now.setting, now.blur_px)
    return now if mean is None else replace(mean, images=images)
