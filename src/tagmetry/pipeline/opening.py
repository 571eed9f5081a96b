"""One call for every source of images, the simulated cameras among them."""

from tagmetry.camera import Camera, Source
from tagmetry.errors import InputError
from tagmetry.sources import OnState, open_source

_TWIN = "twin:"
_RECORDING = ".mcap"
_SCENE_FILES = (".yaml", ".yml")


def open_images(
    spec: str, *, camera: Camera | None = None, on_state: OnState | None = None
) -> Source:
    """Open a source of images.

    Args:
        spec: What `sources.open_source` understands, a recording (`run.mcap`), or of the twin: a
            simulated camera (`twin:webcam`, `twin:overhead`, `twin:mono`), a ready-made scene
            (`twin:room`) or a scene's file (`twin:desk.yaml`). Those tell their exact intrinsics,
            where none are given.
        camera: Intrinsics that every image must fit.
        on_state: Told when a live source is lost and found again, from another thread.

    Raises:
        InputError: It is not there, or nothing that is understood.
        MissingExtraError: It needs an optional part of tagmetry.
    """
    if spec.lower().endswith(_RECORDING):
        from tagmetry.record.mcap import Replay

        return Replay(spec, camera=camera)
    if not spec.startswith(_TWIN):
        return open_source(spec, camera=camera, on_state=on_state)
    return _open_twin(spec.removeprefix(_TWIN), tells_camera=camera is None)


def _open_twin(name: str, *, tells_camera: bool) -> Source:
    from tagmetry.pipeline.recipe_source import RecipeSource
    from tagmetry.twin.camera import READY_CAMERAS, ready_camera
    from tagmetry.twin.scene_files import load_recipe
    from tagmetry.twin.scenes.ready import READY, ready_recipe

    if name.lower().endswith(_SCENE_FILES):
        return RecipeSource(load_recipe(name), name, tells_camera=tells_camera)
    if name in READY:
        return RecipeSource(ready_recipe(name), name, tells_camera=tells_camera)
    if name in READY_CAMERAS:
        return ready_camera(name, tells_camera=tells_camera)
    raise InputError(
        f"expected twin:{', twin:'.join((*READY_CAMERAS, *READY))} or a scene's file like "
        f"twin:desk.yaml, got twin:{name[:40]}"
    )


def tells_camera(spec: str) -> bool:
    """Say whether the images of a source come with their intrinsics."""
    return spec.startswith(_TWIN)
