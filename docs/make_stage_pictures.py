"""Make the pictures of the page about the detector, from a rendered scene: `make pages`."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
from matplotlib.figure import Figure
from scipy.special import ndtr, ndtri

from tagmetry.camera import Camera, scaled
from tagmetry.detect import Detector
from tagmetry.detect.photometric import Picture, fit_pictures
from tagmetry.detect.sides import refine
from tagmetry.detect.stages import look_through
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, family, marker_corners_m
from tagmetry.record.stages.write import grouped_panels
from tagmetry.twin import Look, photograph, render, showcase

IMAGES = Path(__file__).parent / "images" / "detector"
SIZE_PX = (640, 360)
WARM = np.array([0.78, 0.92, 1.0])  # blue, green, red of a lamp
EXPONENTS = np.linspace(1.0, 2.6, 9)
BLACK, WHITE, BLUR_PX = 0.05, 0.7, 0.6  # of light
SIDE_PX, FOCAL_PX = 60.0, 1400.0
DPI = 100


def stage_pictures() -> None:
    """Render the showcase in the light of a warm lamp, and write what every stage sees of it."""
    camera = scaled(showcase.CAMERA, *SIZE_PX)
    shot = replace(showcase.shot(), camera=camera)
    grey = photograph(showcase.scene(), shot, np.random.default_rng(1))
    image = np.rint(grey[..., None] * WARM).astype(np.uint8)
    for _, panels in grouped_panels(look_through(image, Detector([showcase.FAMILY]), camera)):
        for panel in panels:
            path = IMAGES / f"{panel.name}.jpg"
            cv2.imwrite(str(path), panel.pixels, [cv2.IMWRITE_JPEG_QUALITY, 88])


def gamma_picture() -> Figure:
    """Return how far a response curve moves a marker's sides, by theory and as measured."""
    shifts = np.array([measured_shifts_px(exponent) for exponent in EXPONENTS])
    fine = np.linspace(EXPONENTS[0], EXPONENTS[-1], 100)
    figure = Figure(figsize=(6.4, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(fine, [edge_shift_px(one) for one in fine], "--", color="0.5", label="formula, edges")
    axes.plot(
        EXPONENTS, shifts[:, 0], "o", color="#D55E00", label="measured, a blurred step per side"
    )
    axes.plot(
        EXPONENTS, shifts[:, 1], "o", color="#0072B2", label="measured, whole picture with exponent"
    )
    axes.set_xlabel("exponent of the response curve")
    axes.set_ylabel("sides move outward (px)")
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def edge_shift_px(exponent: float) -> float:
    """Return where a blurred edge passes the middle of its grey values, outward of a black square.

    The blur is the lens's with the pixel's own square in it.
    """
    black, white = BLACK ** (1 / exponent), WHITE ** (1 / exponent)
    light = ((black + white) / 2) ** exponent
    return float(np.hypot(BLUR_PX, np.sqrt(1 / 12)) * ndtri((light - BLACK) / (WHITE - BLACK)))


def measured_shifts_px(exponent: float) -> tuple[float, float]:
    """Return by how much both ways of refining move a marker's sides outward."""
    grey, corners_px = encoded_marker(exponent)
    picture = Picture(family("tag36h11").picture(7))
    by_sides = refine(grey, corners_px[None], np.array([picture.side_cells])).corners_px[0]
    by_picture = fit_pictures(grey, corners_px[None], [picture]).corners_px[0]
    return outward_px(by_sides, corners_px), outward_px(by_picture, corners_px)


def outward_px(found_px: Array, corners_px: Array) -> float:
    """Return how much farther sides are from the middle, from the square's area."""
    sides = [np.sqrt(area(one)) for one in (found_px, corners_px)]
    return float(sides[0] - sides[1]) / 2


def area(corners: Array) -> float:
    across, down = corners[2] - corners[0], corners[3] - corners[1]
    return float(abs(across[0] * down[1] - across[1] * down[0]) / 2)


def encoded_marker(exponent: float) -> tuple[GreyPixels, Array]:
    """Return a marker as a camera with this response shows it, and its true corners."""
    camera = Camera(121, 121, (FOCAL_PX, FOCAL_PX), (60.2, 59.7))
    turned = Rotation.from_euler("xz", [180, 17], degrees=True)
    size_m = 0.1
    T_camera_marker = RigidTransform.from_components([0, 0, FOCAL_PX * size_m / SIDE_PX], turned)
    marker = MountedMarker("tag36h11", 7, size_m, RigidTransform.identity())
    look = Look(black=255 * BLACK, white=255 * WHITE, noise=0.0, blur_px=BLUR_PX)
    light = render([marker], T_camera_marker, camera, np.random.default_rng(0), look) / 255
    grey = np.rint(255 * light ** (1 / exponent)).astype(np.uint8)
    return grey, camera.project(T_camera_marker.apply(marker_corners_m(size_m)))


def step_picture() -> Figure:
    """Return a blurred edge in light and after a response curve of 2.2."""
    place = np.linspace(-3, 3, 300)
    light = BLACK + (WHITE - BLACK) * ndtr(place / np.hypot(BLUR_PX, np.sqrt(1 / 12)))
    figure = Figure(figsize=(6.4, 2.9), layout="constrained")
    for axes, exponent, title in zip(
        figure.subplots(1, 2), (1.0, 2.2), ("light", "grey values"), strict=True
    ):
        value = light ** (1 / exponent)
        middle = (value[0] + value[-1]) / 2
        axes.plot(place, value, color="#0072B2")
        axes.axhline(middle, color="0.6", linewidth=0.8)
        axes.axvline(np.interp(middle, value, place), color="#D55E00", linestyle="--")
        axes.axvline(0.0, color="0.3", linewidth=0.8)
        axes.set_title(f"{title} (exponent {exponent:g})")
        axes.set_xlabel("distance outward (px)")
    return figure


if __name__ == "__main__":
    IMAGES.mkdir(parents=True, exist_ok=True)
    stage_pictures()
    for name, figure in (("gamma", gamma_picture()), ("step", step_picture())):
        figure.savefig(IMAGES / f"{name}.png", dpi=DPI)
