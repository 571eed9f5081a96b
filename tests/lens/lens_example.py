"""A camera like the paper's, by formulas of its own: nothing of the twin is in it."""

import numpy as np

from tagmetry.camera import BankNode, BrownLens, Camera, CameraBank
from tagmetry.camera.controls import Control
from tagmetry.lens import LogLaw, MarkerKind, ZoomLens

ZOOM = Control("zoom", 100.0, 500.0, 1.0, 100.0, "percent")
FOCUS = Control("focus", 0.0, 150.0, 1.0, 0.0)
MARKER = MarkerKind(0.01, 8)


def camera_at(focus: float, sd_share: float = 3e-4) -> Camera:
    """Intrinsics that breathe: 1100 px at infinity, 3 mm of focal length."""
    distance_m = float(np.exp((4.0 - focus) / 42.11))
    focal_px = 1100 * (1 + 0.003 / distance_m)
    sds = np.array([sd_share * focal_px, sd_share * focal_px, 0.3, 0.3, 1e-4, 1e-4, 1e-5, 1e-5])
    return Camera(
        1920,
        1080,
        (focal_px, focal_px),
        (961.0, 538.0),
        BrownLens((0.04, -0.06, 0.0005, -0.0004)),
        covariance=np.diag(sds**2),
        focus=focus,
        name="example",
    )


def lens(step: float = 5.0, aperture_m: float = 0.0016) -> ZoomLens:
    """The lens with calibrations so many steps apart."""
    nodes = tuple(BankNode(camera_at(float(focus))) for focus in np.arange(0, 151, step))
    bank = CameraBank(nodes, zoom_is_digital=True)
    return ZoomLens(ZOOM, FOCUS, LogLaw(), bank, aperture_m, 0.05, 1.1, native_percent=200.0)
