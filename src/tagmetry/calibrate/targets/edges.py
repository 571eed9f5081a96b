"""How a known camera shows the edges that cross at a board's corners."""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.targets.bends import curvature
from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform

_APART = 0.25  # steps; an edge over a window of +- 1/3 step pulls like the circle through these


@dataclass(frozen=True, eq=False)
class Edges:
    """The edges through n corners, NaN where the lens does not show them.

    Attributes:
        steps_px: The edges' directions and lengths to the board's right and down, one in each
            column, shape (n, 2, 2).
        bends: Their curvatures, positive where they turn from x to y, shape (n, 2), 1 / px.
    """

    steps_px: Array
    bends: Array


def predicted_edges(
    camera: Camera, T_camera_board: RigidTransform, p_board: Array, step_m: float
) -> Edges:
    """Return the edges at corners of a board as a camera shows them.

    Args:
        camera: The camera.
        T_camera_board: Where the board is.
        p_board: The corners, shape (n, 3), metres.
        step_m: How long the edges are, from a corner to the next.
    """
    right, down = np.array([1.0, 0.0, 0.0]), np.array([0.0, -1.0, 0.0])
    both = [_edge(camera, T_camera_board, p_board, step_m * along) for along in (right, down)]
    steps_px, bends = zip(*both, strict=True)
    return Edges(np.stack(steps_px, axis=-1), np.stack(bends, axis=-1))


def _edge(
    camera: Camera, T_camera_board: RigidTransform, p_board: Array, step_m: Array
) -> tuple[Array, Array]:
    """Return step (n, 2) and curvature (n,) of edges along a step of the board, shape (3,)."""
    before, here, after = (
        camera.project(T_camera_board.apply(p_board + share * step_m))
        for share in (-_APART, 0.0, _APART)
    )
    return (after - before) / (2 * _APART), curvature(before, here, after)
