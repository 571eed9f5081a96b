"""Make the pictures of the twin's effects, one switched on at a time: `make pages`."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import CharucoBoard, cube
from tagmetry.twin import Optics, Scene, Shot, Shutter, photograph
from tagmetry.twin.optics import Gamma, Hdr, Sensor, ThinLens, Vignetting
from tagmetry.twin.rendering import DigitalZoom
from tagmetry.twin.scenes import (
    Lamp,
    Light,
    Steady,
    Still,
    board_thing,
    body_thing,
    looking,
    surface,
    textured,
)

IMAGES = Path(__file__).parent / "images" / "twin"
CAMERA = Camera(420, 300, (430.0, 430.0), (209.5, 149.5))
PLACE = looking(np.array([0.0, -0.62, 0.42]), np.array([0.02, 0.0, 0.075]))
CLEAN = Shot(CAMERA, Still(PLACE), optics=Optics(blur_px=0.6), brightness=0.9)


def at(x_m: float, y_m: float, z_m: float, axes: str, *turns_deg: float) -> Still:
    turn = Rotation.from_euler(axes, list(turns_deg), degrees=True)
    return Still(RigidTransform.from_components([x_m, y_m, z_m], turn))


def desk(light: Light) -> Scene:
    """A board that leans back, a cube with markers, on a desk with a grain."""
    rng = np.random.default_rng(4)
    grain = np.cumsum(rng.normal(0, 0.03, (160, 80)), axis=1)
    top = textured("desk", 0.45 + 0.3 * np.tanh(grain), 0.0125, at(0, 0.1, 0, "z", 15))
    board = board_thing(CharucoBoard(6, 5, 0.04, 0.03, "4x4_50"), at(-0.1, 0.06, 0.11, "x", 62))
    block = cube("cube", 0.1, 0.075, "tag36h11", (1, 2, 3, 4, 5, None))
    return Scene((top, board, body_thing(block, at(0.17, 0.02, 0.05, "z", 28))), light)


def window() -> Scene:
    """The same in front of a window with the sky behind."""
    scene = desk(Light(0.25))
    pane = surface("window", 0.7, 0.5, at(0.1, 0.5, 0.2, "x", 90), glow=7.0)
    return Scene((pane, *scene.things), scene.light, background=0.1)


def pictures() -> Iterator[tuple[str, Scene, Shot]]:
    even, lamp = desk(Light(1.0)), desk(Light(0.25, (Lamp(np.array([-0.5, -0.2, 0.5]), 0.4),)))
    yield "clean", even, CLEAN
    bent = replace(CAMERA, lens=BrownLens((-0.38, 0.12, 0.0, 0.0)))
    yield "distortion", even, replace(CLEAN, camera=bent)
    wide = replace(CAMERA, focal_px=(190.0, 190.0), lens=FisheyeLens((0.02, 0.0, 0.0, 0.0)))
    near = looking(np.array([0.0, -0.3, 0.28]), np.array([0.015, 0.0, 0.08]))
    yield "fisheye", even, replace(CLEAN, camera=wide, path=Still(near))
    yield "blur", even, replace(CLEAN, optics=Optics(blur_px=2.0))
    lens = ThinLens.from_f_number(0.012, 1.4, 0.012 / 430)
    yield "defocus", even, replace(CLEAN, optics=Optics(0.6, lens, focus_m=0.4))
    passing = Steady(PLACE, np.array([0.5, 0.0, 0.0]), np.zeros(3))
    yield "motion", even, replace(CLEAN, path=passing, shutter=Shutter(exposure_s=0.03))
    turning = Steady(PLACE, np.zeros(3), np.array([0.0, 0.0, 1.6]))
    yield "rolling", even, replace(CLEAN, path=turning, shutter=Shutter(line_s=4e-4))
    yield "zoom", even, replace(CLEAN, zoom=DigitalZoom(3.0))
    yield (
        "vignetting",
        even,
        replace(CLEAN, optics=Optics(0.6, vignetting=Vignetting(1.0, (-0.5,)))),
    )
    yield "lamp", lamp, CLEAN
    yield "backlight", window(), replace(CLEAN, optics=Optics(0.6, veil=0.06))
    hdr = Sensor(response=Hdr(stops=5.0, knee=0.12))
    yield "hdr", window(), replace(CLEAN, optics=Optics(0.6, veil=0.06), sensor=hdr, brightness=3.0)
    yield "gamma", even, replace(CLEAN, sensor=Sensor(response=Gamma(2.2)))
    noisy = Sensor(full_well_e=4000, read_noise_e=8, gain=12.0)
    yield "noise", even, replace(CLEAN, sensor=noisy, brightness=0.9 / 12)
    yield "jpeg", even, replace(CLEAN, sensor=Sensor(jpeg_quality=12))


def main() -> None:
    IMAGES.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(0)
    for name, scene, shot in pictures():
        pixels = photograph(scene, shot, rng)
        cv2.imwrite(str(IMAGES / f"{name}.png"), pixels, [cv2.IMWRITE_PNG_COMPRESSION, 9])


if __name__ == "__main__":
    main()
