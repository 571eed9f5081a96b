"""The twin's webcam as a lens that was calibrated: what a person with such a camera would know.

The bank is solved from chessboards whose corners are where the twin's optics put them, with the
noise that rendered boards show; it knows nothing of the truth but that.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from tagmetry.calibrate.view import BoardView
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.camera import BankNode, Camera, CameraBank
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import LogLaw, ZoomLens
from tagmetry.twin.camera import Device, Setting, webcam
from tagmetry.twin.camera.intrinsics import image_camera

CORNER_SD_PX = 0.03
_GRID = (11, 7)
_VIEWS = 16


def calibrated_lens(device: Device, *, step: float = 5.0, seed: int = 0) -> ZoomLens:
    """Return what calibrating a simulated camera every so many steps of focus tells of it."""
    focus, zoom = device.available["focus"], device.available["zoom"]
    values = np.arange(focus.least, focus.most + step / 2, step)
    rng = np.random.default_rng(seed)
    nodes = tuple(BankNode(_solved(device, float(value), rng)) for value in values)
    return ZoomLens(
        zoom,
        focus,
        LogLaw(),
        CameraBank(nodes, zoom_is_digital=True),
        device.lens.aperture_m,
        nearest_m=0.05,
        farthest_m=1.1,
        native_percent=100 * device.sensor.width_px / device.size_px[0],
    )


@lru_cache(maxsize=2)
def webcam_lens(step: float = 5.0) -> ZoomLens:
    """Return the paper's webcam, calibrated at every 5 steps of focus."""
    return calibrated_lens(webcam(), step=step)


def _solved(device: Device, focus: float, rng: np.random.Generator) -> Camera:
    """Return the camera solved from views at a focus value."""
    true = image_camera(device, Setting(focus=focus))
    depth_m = float(np.clip(device.focus_law.distance_m(focus), 0.05, 0.6))
    views = [simulated_view(true, depth_m, number, rng) for number in range(_VIEWS)]
    camera = calibrate(views, "brown5").camera
    return replace(camera, focus=focus, zoom=1.0, name=device.name)


def simulated_view(
    true: Camera, depth_m: float, number: int, rng: np.random.Generator
) -> BoardView:
    """Return a chessboard that fills most of the image, tilted to another side each time."""
    columns, rows = _GRID
    square_m = 0.75 * depth_m * true.width_px / true.focal_px[0] / columns
    x, y = np.meshgrid(np.arange(columns) - (columns - 1) / 2, np.arange(rows) - (rows - 1) / 2)
    p_board = square_m * np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    tilt = np.radians(rng.uniform(15, 40)) * np.array(
        [np.cos(2.4 * number), np.sin(2.4 * number), 0.0]
    )
    facing = Rotation.from_euler("xz", [180.0, rng.uniform(-20, 20)], degrees=True)
    turned = Rotation.from_rotvec(tilt) * facing
    aside = rng.uniform(-0.12, 0.12, 2) * depth_m
    at = RigidTransform.from_components([*aside, depth_m * rng.uniform(0.95, 1.2)], turned)
    pixels = true.project(at.apply(p_board))
    pixels = pixels + rng.normal(0, CORNER_SD_PX, pixels.shape)
    shown = np.asarray(true.contains(pixels))
    points = np.flatnonzero(shown)
    noise_px2 = np.tile(CORNER_SD_PX**2 * np.eye(2), (len(points), 1, 1))
    return BoardView(
        true.width_px, true.height_px, points, p_board[shown], pixels[shown], noise_px2
    )
