"""The lens as it was calibrated, for the page: its bank as a table, its focus curve."""

from typing import Any

import numpy as np

from tagmetry.camera import Camera
from tagmetry.pipeline.lens.twin import webcam_lens

_DEPTHS = 60


def bank_table() -> dict[str, Any]:
    """Return calibrations by rising focus, and the focus that is sharp at each depth."""
    lens = webcam_lens()
    depths_m = np.geomspace(lens.nearest_m, lens.farthest_m, _DEPTHS)
    nodes = [_node(node.camera) for node in lens.bank.nodes]
    curve = [[float(depth_m), float(lens.law.value(float(depth_m)))] for depth_m in depths_m]
    return {"nodes": sorted(nodes, key=lambda node: node["focus"]), "curve": curve}


def _node(camera: Camera) -> dict[str, float | None]:
    sd = np.sqrt(np.diag(camera.covariance)) if camera.covariance is not None else None
    return {
        "focus": camera.focus,
        "fx_px": camera.focal_px[0],
        "fx_sd_px": None if sd is None else float(sd[0]),
        "cx_px": camera.center_px[0],
        "cy_px": camera.center_px[1],
        "k1": camera.lens.coefficients[0],
    }
