"""Cameras to begin with: those of the published experiments, and a machine's."""

import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.camera.controls import Control
from tagmetry.twin.camera.device import Breathing, Device
from tagmetry.twin.camera.focus_law import FixedFocus, LogFocus
from tagmetry.twin.camera.setting import Setting
from tagmetry.twin.optics.response import Srgb
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import Vignetting


def webcam() -> Device:
    """Return the webcam of the experiments with a 10 mm marker: full HD out of a 4K sensor.

    90 degrees along the diagonal, 30 images per second, zoom 100 to 500, focus 0 to 150 (1.10 m
    to 0.03 m). Both auto modes are on at first, as in most webcams.

    Reference: Tables 1 and 2 of the paper on dynamic camera control for micro markers. The rest
    (aperture, pixels, distortion, noise, delays) is what such cameras have.
    """
    focal_px = float(np.hypot(3840, 2160)) / 2  # 90 degrees: half the diagonal
    pixel_m = 1.45e-6
    sensor = Camera(
        3840,
        2160,
        (focal_px, focal_px),
        (1931.3, 1067.6),
        BrownLens((0.041, -0.063, 0.0006, -0.0004, 0.011)),
    )
    return Device(
        "webcam",
        sensor,
        (1920, 1080),
        30.0,
        ThinLens.from_f_number(focal_px * pixel_m, 2.0, pixel_m),
        LogFocus(),
        Breathing(1.0, (0.0006, -0.0003, 0.0, 0.0, 0.0)),
        sensitivity_per_s=60.0,
        pixels=Sensor(bits=12, full_well_e=6000.0, read_noise_e=3.0),
        output=Sensor(response=Srgb()),
        vignetting=Vignetting(cos4=0.5),
        line_s=7e-6,
        controls=_webcam_controls(),
        delay_images={"zoom": 1, "focus": 1, "exposure": 2, "gain": 2},
        speed_per_s={"focus": 1000.0},
    )


def overhead_camera() -> Device:
    """Return a full HD camera under a ceiling with 120 images per second and a fixed focus.

    Reference: Section 3 of the paper on overhead vision for swarms of wheeled robots; its sensor is
    an OV4689, of whose 2688 x 1520 pixels of 2 um the video mode shows the middle.
    """
    sensor = Camera(
        1920, 1080, (1273.0, 1273.0), (952.4, 545.1), BrownLens((-0.26, 0.08, 0.0004, -0.0007))
    )
    return Device(
        "overhead",
        sensor,
        (1920, 1080),
        120.0,
        ThinLens.from_f_number(1273 * 2e-6, 2.4, 2e-6),
        FixedFocus(2.5),
        sensitivity_per_s=200.0,
        pixels=Sensor(bits=10, full_well_e=7000.0, read_noise_e=3.0),
        output=Sensor(response=Srgb()),
        vignetting=Vignetting(cos4=0.7),
        line_s=7e-6,
        preset=Setting(exposure_s=0.004),
        controls=(
            Control("exposure", 1e-4, 8e-3, 1e-4, 4e-3, "s"),
            Control("gain", 1.0, 16.0, 0.1, 1.0, "factor"),
        ),
        delay_images={"exposure": 2, "gain": 2},
    )


def mono_camera() -> Device:
    """Return a machine's camera: grey, 12-bit pixels, global shutter, linear, a good fixed lens."""
    sensor = Camera(
        1440, 1080, (2320.0, 2320.0), (722.7, 537.2), BrownLens((-0.09, 0.13, 0.0002, -0.0001))
    )
    return Device(
        "mono",
        sensor,
        (1440, 1080),
        100.0,
        ThinLens.from_f_number(2320 * 3.45e-6, 5.6, 3.45e-6),
        FixedFocus(0.6),
        sensitivity_per_s=180.0,
        pixels=Sensor(bits=12, full_well_e=10500.0, read_noise_e=2.3),
        preset=Setting(exposure_s=0.005),
        controls=(
            Control("exposure", 2e-5, 9.9e-3, 1e-5, 5e-3, "s"),
            Control("gain", 1.0, 16.0, 0.0, 1.0, "factor"),
        ),
        delay_images={"exposure": 1, "gain": 1},
    )


def _webcam_controls() -> tuple[Control, ...]:
    return (
        Control("zoom", 100.0, 500.0, 1.0, 100.0, "percent"),
        Control("focus", 0.0, 150.0, 1.0, 0.0),
        Control("exposure", 1e-4, 333e-4, 1e-4, 156e-4, "s"),
        Control("gain", 1.0, 8.0, 0.1, 1.0, "factor"),
        Control("auto_focus", 0.0, 1.0, 1.0, 1.0),
        Control("auto_exposure", 0.0, 1.0, 1.0, 1.0),
    )
