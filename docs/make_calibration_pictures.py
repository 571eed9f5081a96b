"""Make the pictures of a calibration, from a rendered set whose truth is known: `make pages`."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from tagmetry.camera import BrownLens, Camera, Image
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard
from tagmetry.pipeline.board_pictures import look
from tagmetry.pipeline.calibration import CalibrationRun, Request, run_calibration
from tagmetry.record.calibration_report.figures import every_figure
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics import Sensor
from tagmetry.twin.scenes import Still, board_thing

IMAGES = Path(__file__).parent / "images" / "calibration"
BOARD = Chessboard(9, 6, 0.025)
CAMERA = Camera(640, 480, (560.0, 560.0), (325.0, 236.0), BrownLens((-0.28, 0.09, 0.0, 0.0)))
VIEWS = 12
DRAWN = ("uncertainty", "residuals", "coverage")
DPI = 80


def places() -> Iterator[RigidTransform]:
    """Give T_camera_board of boards all over the image but its lower right, tilted to all sides."""
    rng = np.random.default_rng(8)
    while True:
        around, tilt = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(10, 40))
        turn = Rotation.from_rotvec(tilt * np.array([np.cos(around), np.sin(around), 0.0]))
        turn = turn * Rotation.from_euler("x", 180, degrees=True)
        place = [rng.uniform(-0.25, 0.16), rng.uniform(-0.18, 0.12), rng.uniform(0.38, 0.65)]
        T_camera_board = RigidTransform.from_components(place, turn)
        u, v = CAMERA.project(T_camera_board.apply(BOARD.corners_m)).T
        if ((u > 12) & (u < 627) & (v > 12) & (v < 467)).all() and (u + v).max() < 850:
            yield T_camera_board


def photographed(T_camera_board: RigidTransform, seed: int) -> GreyPixels:
    scene = Scene((board_thing(BOARD, Still(T_camera_board), margin_m=0.02),))
    shot = Shot(
        CAMERA,
        Still(RigidTransform.identity()),
        optics=Optics(blur_px=0.8),
        sensor=Sensor(noise_grey=12.0),
    )
    return np.asarray(photograph(scene, shot, np.random.default_rng(seed)), dtype=np.uint8)


def draw_views(run: CalibrationRun) -> Figure:
    """Return small pictures of the views."""
    figure = Figure(figsize=(7.0, 4.1), layout="constrained")
    for axes, one, view, rms_px in zip(
        figure.subplots(3, 4).ravel(),
        run.thumbnails,
        run.calibration.views,
        run.calibration.view_rms_px,
        strict=False,
    ):
        axes.imshow(one, cmap="gray", vmin=0, vmax=255)
        share = one.shape[1] / view.width_px
        axes.plot(*(view.corners_px * share).T, ".", ms=1.5, color="#e69f00")
        axes.set_title(f"{Path(view.source).stem}: {rms_px:.3f} px", fontsize=8)
        axes.axis("off")
    return figure


def save(figure: Figure, name: str) -> None:
    """Write a figure, small enough for a page."""
    figure.savefig(IMAGES / f"{name}.png", dpi=DPI, pil_kwargs={"optimize": True})


def main() -> None:
    IMAGES.mkdir(parents=True, exist_ok=True)
    poses = places()
    shots = [photographed(next(poses), seed) for seed in range(VIEWS)]
    seen = [look(Image(pixels, source=f"view{i + 1}.png"), BOARD) for i, pixels in enumerate(shots)]
    run = run_calibration(seen, Request(BOARD, "brown4"))
    for figure in every_figure(run.facts):
        if figure.name in DRAWN:
            save(figure.draw(), figure.name)
    save(draw_views(run), "views")


if __name__ == "__main__":
    main()
