"""The truth of one picture as JSON, full precision; what is not known (NaN) is null."""

import json

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.twin.truth.image import BoardTruth, ImageTruth, MarkerTruth


def truth_line(truth: ImageTruth, source: str, sequence: int) -> str:
    """Return the truth of a picture as one line of JSON, without the line's end.

    Args:
        truth: What is so.
        source: Name of the picture.
        sequence: Its number among the pictures, from 0.
    """
    line = {
        "source": source,
        "sequence": sequence,
        "time_s": truth.time_s,
        "camera": _camera(truth.camera),
        "T_world_camera": _pose(truth.T_world_camera),
        "things": [
            {"name": one.name, "T_world_thing": _pose(one.T_world_thing)} for one in truth.things
        ],
        "markers": [_marker(one) for one in truth.markers],
        "boards": [_board(one) for one in truth.boards],
    }
    return json.dumps(line, allow_nan=False, separators=(",", ":"))


def _camera(camera: Camera) -> dict[str, object]:
    return {
        "size_px": list(camera.size_px),
        "focal_px": _numbers(camera.focal_px),
        "center_px": _numbers(camera.center_px),
        "lens": camera.lens.kind,
        "coefficients": _numbers(camera.lens.coefficients),
    }


def _marker(one: MarkerTruth) -> dict[str, object]:
    return {
        "family": one.family,
        "id": one.id,
        "size_m": one.size_m,
        "thing": one.thing,
        "T_camera_marker": _pose(one.T_camera_marker),
        "corners_px": _numbers(one.corners_px),
        "visible_fraction": one.visible_fraction,
        "distance_m": one.distance_m,
        "depth_m": one.depth_m,
        "tilt_deg": one.tilt_deg,
        "side_px": _numbers(one.side_px),
        "disc_px": _numbers(one.disc_px),
    }


def _board(one: BoardTruth) -> dict[str, object]:
    return {
        "thing": one.thing,
        "T_camera_board": _pose(one.T_camera_board),
        "corners_px": _numbers(one.corners_px),
    }


def _pose(T_a_b: RigidTransform) -> dict[str, object]:
    """Return a pose as the files of this package spell it; w of the quaternion is not negative."""
    return {
        "rotation_xyzw": _numbers(T_a_b.rotation.as_quat(canonical=True)),
        "translation_m": _numbers(T_a_b.translation),
    }


def _numbers(values: object) -> object:
    """Return a number or nested numbers as JSON holds them, null for those not finite."""
    if isinstance(values, (list, tuple, np.ndarray)):
        return [_numbers(value) for value in values]
    number = float(values)  # type: ignore[arg-type]
    return number + 0.0 if np.isfinite(number) else None
