"""One call for every source of images, the simulated cameras among them."""

from tagmetry.camera import Camera, Source
from tagmetry.sources import OnState, open_source

_TWIN = "twin:"


def open_images(
    spec: str, *, camera: Camera | None = None, on_state: OnState | None = None
) -> Source:
    """Open a source of images.

    Args:
        spec: What `sources.open_source` understands, or a simulated camera: `twin:webcam`,
            `twin:overhead`, `twin:mono`. Those tell their exact intrinsics, where none are given.
        camera: Intrinsics that every image must fit.
        on_state: Told when a live source is lost and found again, from another thread.

    Raises:
        InputError: It is not there, or nothing that is understood.
        MissingExtraError: It needs an optional part of tagmetry.
    """
    if not spec.startswith(_TWIN):
        return open_source(spec, camera=camera, on_state=on_state)
    from tagmetry.twin.camera import ready_camera

    return ready_camera(spec.removeprefix(_TWIN), tells_camera=camera is None)


def tells_camera(spec: str) -> bool:
    """Say whether the images of a source come with their intrinsics."""
    return spec.startswith(_TWIN)
