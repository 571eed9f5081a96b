"""Make the pictures of README and documentation with the program itself: `make pages`."""

from pathlib import Path

import cv2
import numpy as np

import tagmetry
from tagmetry.camera import BrownLens
from tagmetry.cli.main import run
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, cube
from tagmetry.record.overlay import draw_overlay
from tagmetry.twin import Look, render

IMAGES = Path(__file__).parent / "images"
CAMERA = tagmetry.Camera(
    1280, 720, (1100.0, 1100.0), (639.5, 359.5), BrownLens((-0.18, 0.06, 0.0, 0.0))
)
SIZE_M = 0.12


def scene() -> list[MountedMarker]:
    """Return a cube and some markers on a wall behind it, in the frame of the wall."""
    standing = cube("cube", 0.15, SIZE_M, "tag36h11", (10, 11, 12, 13, 14, None))
    turned = Rotation.from_euler("xyx", [-90, 22, 28], degrees=True)
    T_wall_cube = RigidTransform.from_components([0.12, -0.04, 0.2], turned)
    on_cube = [
        MountedMarker(m.family, m.id, m.size_m, T_wall_cube * m.T_body_marker)
        for m in standing.markers
    ]
    places = (
        (0, -0.44, 0.16, 10),
        (1, -0.16, 0.18, -25),
        (2, 0.46, 0.2, 45),
        (3, -0.36, -0.14, 80),
    )
    on_wall = [
        MountedMarker(
            "tag36h11",
            marker_id,
            SIZE_M,
            RigidTransform.from_components(
                [x_m, y_m, 0.0], Rotation.from_euler("z", turn_deg, degrees=True)
            ),
        )
        for marker_id, x_m, y_m, turn_deg in places
    ]
    return [*on_wall, *on_cube]


def overlay() -> None:
    """Render, detect, measure and draw."""
    R_camera_wall = Rotation.from_euler("xy", [200, -12], degrees=True)
    T_camera_wall = RigidTransform.from_components([0.0, 0.0, 1.15], R_camera_wall)
    picture = render(scene(), T_camera_wall, CAMERA, np.random.default_rng(1), Look(noise=0.0))
    detections = tagmetry.Detector(["tag36h11"]).detect(picture, CAMERA)
    poses = [tagmetry.estimate_pose(one, CAMERA, SIZE_M) for one in detections]
    drawn = draw_overlay(picture, detections, poses, CAMERA)
    cv2.imwrite(str(IMAGES / "overlay.png"), drawn, [cv2.IMWRITE_PNG_COMPRESSION, 9])


def sheet() -> None:
    """Print the sheet that the first tutorial prints, for the screen."""
    path = IMAGES / "sheet.png"
    options = ["--ids", "0-5", "--size", "60mm", "--dpi", "75", "--out", str(path)]
    run(["print", "sheet", *options])


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    overlay()
    sheet()
