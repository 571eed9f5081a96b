"""The noise that thresholds follow is measured right, also on edges and slopes."""

import numpy as np
import pytest

from tagmetry.detect.quads import noise


@pytest.mark.parametrize("deviation", [0.5, 2.0, 8.0, 20.0])
@pytest.mark.parametrize("ground", ["flat", "slope", "tiles"])
def test_noise_is_measured(deviation: float, ground: str) -> None:
    rng = np.random.default_rng(0)
    x, y = np.meshgrid(np.arange(600), np.arange(400))
    flat = np.full((400, 600), 120.0)
    grounds = {"flat": flat, "slope": 90 + 0.1 * x, "tiles": 90 + 60.0 * ((x // 40 + y // 40) % 2)}
    grey = np.clip(np.rint(grounds[ground] + rng.normal(0, deviation, flat.shape)), 0, 255)
    assert noise(grey.astype(np.uint8)) == pytest.approx(deviation, rel=0.12)


def test_a_clean_image_has_no_noise() -> None:
    assert noise(np.full((8, 8), 90, np.uint8)) == 0.0
