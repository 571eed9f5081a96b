"""The whole way once, on a rendered scene: print, photograph, detect, measure, compare."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from tagmetry.camera import Image
from tagmetry.detect import Detector
from tagmetry.errors import MissingExtraError
from tagmetry.files import save_camera
from tagmetry.files.sheets import PageSetup, sheet_pages, write_pages
from tagmetry.geometry import RigidTransform, mahalanobis_squared, pose_difference
from tagmetry.markers import family
from tagmetry.pipeline.measurement import Measurement
from tagmetry.pose import PoseHypothesis
from tagmetry.record import ImageResult, draw_overlay, open_overlay, open_writer
from tagmetry.twin import photograph, showcase


@dataclass(frozen=True)
class Comparison:
    """One marker's measured pose against the truth of the scene.

    Attributes:
        id: Id of the marker.
        position_m: Measured position in the camera frame, shape (3,).
        deviation_m: Stated standard deviations, shape (3,).
        error_m: Measured minus true, shape (3,).
        error_deg: Angle between measured and true rotation.
        distance: Mahalanobis distance of the pose's error; about 2.4 is normal in six dimensions.
    """

    id: int
    position_m: tuple[float, float, float]
    deviation_m: tuple[float, float, float]
    error_m: tuple[float, float, float]
    error_deg: float
    distance: float


@dataclass(frozen=True)
class Demonstration:
    """What was measured and which files were written."""

    result: ImageResult
    comparisons: tuple[Comparison, ...]
    missing: tuple[int, ...]
    files: tuple[Path, ...]


def demonstrate(folder: Path, rng: np.random.Generator) -> Demonstration:
    """Print the markers, render the scene, measure it, and write everything into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    sheets = _printed(folder)
    image = _photographed(rng)
    detector = Detector([showcase.FAMILY])
    task = Measurement(detector, showcase.CAMERA, showcase.SIZE_M)
    result = task.measure(image)
    files = (*sheets, *write_results(folder, image, result, task))
    save_camera(showcase.CAMERA, folder / "camera.yaml")
    comparisons = _compared(result)
    visible = {marker.id for marker in showcase.markers() if _faces_camera(marker.T_body_marker)}
    missing = tuple(sorted(visible - {one.id for one in comparisons}))
    return Demonstration(result, comparisons, missing, (*files, folder / "camera.yaml"))


def write_results(
    folder: Path, image: Image, result: ImageResult, task: Measurement
) -> tuple[Path, ...]:
    """Write picture, overlay and table of one image; return their paths."""
    overlay, lines, table = (
        folder / name for name in ("overlay.png", "markers.jsonl", "markers.csv")
    )
    drawn = draw_overlay(
        image.pixels,
        [marker.detection for marker in result.markers],
        [marker.pose for marker in result.markers],
        task.camera,
    )
    with open_overlay(overlay) as writer:
        writer.write(replace(image, pixels=drawn))
    for path in (lines, table):
        with open_writer(path) as results:
            results.write(result)
    return overlay, lines, table


def _printed(folder: Path) -> tuple[Path, ...]:
    """Write the sheet to print; without the part for PDF, as SVG."""
    ids = sorted(marker.id for marker in showcase.markers())
    pages = sheet_pages(family(showcase.FAMILY), ids, showcase.SIZE_M, PageSetup())
    try:
        return write_pages(pages, folder / "sheet.pdf")
    except MissingExtraError:
        return write_pages(pages, folder / "sheet.svg")


def _photographed(rng: np.random.Generator) -> Image:
    pixels = photograph(showcase.scene(), showcase.shot(), rng)
    return Image(pixels, source="rendered scene", camera=showcase.CAMERA)


def _compared(result: ImageResult) -> tuple[Comparison, ...]:
    truth = {m.id: showcase.T_camera_wall * m.T_body_marker for m in showcase.markers()}
    return tuple(
        _comparison(marker.detection.id, marker.pose.best, truth[marker.detection.id])
        for marker in result.markers
        if marker.pose is not None and marker.pose.hypotheses and marker.detection.id in truth
    )


def _comparison(
    marker_id: int, measured: PoseHypothesis, T_camera_marker: RigidTransform
) -> Comparison:
    error = pose_difference(measured.T_camera_marker, T_camera_marker)
    x_m, y_m, z_m = measured.T_camera_marker.translation
    sx_m, sy_m, sz_m = np.sqrt(np.diag(measured.covariance)[:3])
    return Comparison(
        marker_id,
        (float(x_m), float(y_m), float(z_m)),
        (float(sx_m), float(sy_m), float(sz_m)),
        (float(error[0]), float(error[1]), float(error[2])),
        float(np.degrees(np.linalg.norm(error[3:]))),
        float(np.sqrt(mahalanobis_squared(error, measured.covariance))),
    )


def _faces_camera(T_wall_marker: RigidTransform) -> bool:
    """Say whether a marker's printed face is turned to the camera."""
    T_camera_marker = showcase.T_camera_wall * T_wall_marker
    outward = T_camera_marker.rotation.as_matrix()[:, 2]
    return bool(outward @ T_camera_marker.translation < 0)
