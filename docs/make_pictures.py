"""Make the pictures of README and documentation with the program itself: `make pages`."""

from pathlib import Path

import cv2
import numpy as np

import tagmetry
from tagmetry.cli.main import run
from tagmetry.record.overlay import draw_overlay
from tagmetry.twin import photograph, showcase

IMAGES = Path(__file__).parent / "images"


def overlay() -> None:
    """Render, detect, measure and draw."""
    camera, rng = showcase.CAMERA, np.random.default_rng(1)
    picture = photograph(showcase.scene(), showcase.shot(), rng)
    detections = tagmetry.Detector([showcase.FAMILY]).detect(picture, camera)
    poses = [tagmetry.estimate_pose(one, camera, showcase.SIZE_M) for one in detections]
    drawn = draw_overlay(picture, detections, poses, camera)
    cv2.imwrite(str(IMAGES / "overlay.png"), drawn, [cv2.IMWRITE_PNG_COMPRESSION, 9])


def sheet() -> None:
    """Print the sheet that the first tutorial prints, for the screen."""
    path = IMAGES / "sheet.png"
    options = ["--ids", "0-5", "--size", "60mm", "--dpi", "75", "--out", str(path)]
    run(["print", "sheet", *options])


def stability() -> None:
    """Draw a follower's distances and margins against the delay, for the twin's robots."""
    twins = ["--untold-ms", "8", "--hold-ms", "200"]
    options = ["--delay-ms", "100", *twins, "--picture", str(IMAGES / "stability.png")]
    run(["arena", "stability", *options])


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    overlay()
    sheet()
    stability()
