"""The sharpest focus of a sweep, and the aperture, against the twin's lens formulas."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.lens import LogLaw, aperture_m, focus_peak
from tagmetry.twin.optics.thin_lens import ThinLens

LENS = ThinLens.from_f_number(3.2e-3, 2.0, 2.9e-6)
LAW = LogLaw()


def blurs_px(focus: np.ndarray, depth_m: float, rng=None) -> np.ndarray:
    discs = np.array([LENS.blur_radius_px(depth_m, LAW.depth_m(f)) for f in focus])
    blur = np.hypot(0.6, discs / 2)
    return blur if rng is None else blur * (1 + rng.normal(0, 0.03, len(focus)))


@pytest.mark.parametrize("depth_m", [0.06, 0.2, 0.8])
def test_the_peak_is_where_the_law_says(depth_m: float) -> None:
    best = LAW.value(depth_m)
    peak = focus_peak(focus := best + np.arange(-12.0, 13.0, 3.0), blurs_px(focus, depth_m))
    assert peak.focus == pytest.approx(best, abs=0.5)
    assert peak.blur_px < 1.3 * 0.6


def test_its_deviation_is_that_of_repeated_sweeps() -> None:
    rng = np.random.default_rng(3)
    focus = np.arange(60.0, 90.0, 4.0)
    peaks = [focus_peak(focus, blurs_px(focus, 0.2, rng)) for _ in range(200)]
    spread = np.std([peak.focus for peak in peaks])
    assert np.mean([peak.sd for peak in peaks]) == pytest.approx(spread, rel=0.4)


def test_the_aperture_is_the_lens_s() -> None:
    focus = np.arange(40.0, 100.0, 5.0)
    found = aperture_m(focus, blurs_px(focus, 0.2), LAW, LAW.value(0.2), 1103.0)
    assert found == pytest.approx(LENS.aperture_m, rel=0.05)


def test_sweeps_that_do_not_reach_the_peak_are_refused() -> None:
    focus = np.arange(0.0, 40.0, 4.0)
    with pytest.raises(InputError, match="sweep farther"):
        focus_peak(focus, blurs_px(focus, 0.2))
    with pytest.raises(InputError, match="4 images"):
        focus_peak([1, 2, 3, 4], [np.nan, 1.0, np.nan, 1.0])
    with pytest.raises(InputError, match="a blur for each"):
        focus_peak([1, 2, 3, 4], [1.0])
