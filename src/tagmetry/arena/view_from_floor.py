"""Where the camera is over the floor: from floor markers whose places are known."""

from collections.abc import Sequence

from tagmetry.arena.on_plane import OverheadView
from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.localize import Localizer, MarkerMap

_AMBIGUOUS = 0.05


def view_from_floor(
    detections: Sequence[Detection], floor: MarkerMap, camera: Camera
) -> OverheadView:
    """Return the camera at its place, by the joint solution over all floor markers that it sees.

    Args:
        detections: All markers of an image.
        floor: The floor markers at their places in the world, whose z is up.
        camera: Intrinsics of the image.

    Raises:
        InputError: No floor marker is seen, or they leave two poses of the camera.
    """
    found = Localizer(floor, camera).locate(detections)
    if not found.hypotheses:
        raise InputError(
            f"the camera's place over the floor is not told: {found.why}; uncover the floor "
            "markers, or take others"
        )
    if found.ambiguity > _AMBIGUOUS:
        raise InputError(
            f"the floor markers leave two places of the camera ({100 * found.ambiguity:.0f} % for "
            "the other one); lay more of them, larger ones, or farther apart"
        )
    if found.T_world_camera.translation[2] <= 0:
        raise InputError(
            "the camera would be below the floor: floor markers lie with their face up"
        )
    return OverheadView(camera, found.T_world_camera, found.covariance)
