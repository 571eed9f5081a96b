"""A bank is calibrated focus by focus, and goes on where it was left."""

from itertools import islice

import numpy as np
import pytest
from webcam_rig import still

from tagmetry.camera.controls import Control
from tagmetry.errors import InputError
from tagmetry.pipeline.lens.bank import calibrate_bank, missing_foci
from tagmetry.pipeline.lens.twin import simulated_view
from tagmetry.twin.camera import webcam
from tagmetry.twin.camera.intrinsics import image_camera

FOCUS = Control("focus", 0.0, 150.0, 1.0, 0.0)


def test_the_paper_s_bank_has_31_sets() -> None:
    foci = missing_foci(None, FOCUS, 5.0)
    assert len(foci) == 31
    assert foci[:2] == (150, 145)
    with pytest.raises(InputError, match="step of the focus"):
        missing_foci(None, FOCUS, 0.0)


def test_each_focus_is_kept_and_an_interrupted_bank_goes_on() -> None:
    camera, device = still(0.3), webcam()

    def views(images):
        next(images)  # the first that shows the focus
        true = image_camera(device, camera.setting())
        rng = np.random.default_rng(0)
        return [simulated_view(true, 0.3, number, rng) for number in range(8)]

    first = next(iter(calibrate_bank(camera, views, step=75.0, name="webcam")))
    assert (first.focus, first.left) == (150, 2)
    rest = list(islice(calibrate_bank(camera, views, first.bank, step=75.0), 5))
    assert [(one.focus, one.left) for one in rest] == [(75, 1), (0, 0)]
    bank = rest[-1].bank
    focal_px = [node.camera.focal_px[0] for node in sorted(bank.nodes, key=lambda n: n.focus)]
    assert (np.diff(focal_px) > 5).all()  # it breathes: each was taken at its own focus
    assert camera.controls.read("auto_focus") == 1
    assert missing_foci(bank, FOCUS, 75.0) == ()
