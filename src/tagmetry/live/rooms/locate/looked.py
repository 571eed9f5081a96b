"""One image on a camera's way, whether it was simulated or taken."""

from collections.abc import Generator
from dataclasses import dataclass
from typing import Protocol

from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.localize import CameraPose, MarkerMap


@dataclass(frozen=True, eq=False)
class Looked:
    """One image.

    Attributes:
        camera: Its intrinsics.
        T_world_camera: Where the camera truly was; None where nobody knows.
        detections: The markers that it saw.
        pose: Where it says it was.
    """

    camera: Camera
    T_world_camera: RigidTransform | None
    detections: tuple[Detection, ...]
    pose: CameraPose


class Way(Protocol):
    """What a camera sees on its way.

    Attributes:
        marker_map: Where the markers stand.
    """

    marker_map: MarkerMap

    def looks(self) -> Generator[Looked]:
        """Give what each image shows."""
