"""Images of an empty floor to an arena's world: where the camera is, and how the floor looks."""

from collections.abc import Iterable, Sequence
from itertools import islice

from tagmetry.arena import floor_corners, lay_floor, view_from_floor
from tagmetry.arena.averaged import averaged
from tagmetry.camera import Camera, Image
from tagmetry.detect import Detection, Detector
from tagmetry.errors import InputError
from tagmetry.files.arena import ArenaSetup, ArenaWorld
from tagmetry.files.text import named_errors
from tagmetry.markers.bodies import MarkerKey


def calibrate_arena(
    images: Iterable[Image], setup: ArenaSetup, camera: Camera, most: int = 30
) -> ArenaWorld:
    """Return the arena's world.

    Args:
        images: Of the floor markers, from the camera where it hangs.
        setup: The arena.
        camera: Intrinsics of the images.
        most: How many images are averaged.

    Raises:
        InputError: A floor marker is not seen, or the floor markers do not tell the camera's place.
    """
    detector = Detector(setup.families)
    seen = averaged([_detected(image, detector, camera) for image in islice(images, most)])
    return world_of(seen, setup, camera)


def world_of(detections: Sequence[Detection], setup: ArenaSetup, camera: Camera) -> ArenaWorld:
    """Return the arena's world as the markers of one image, or their means, tell it."""
    of_floor = [one for one in detections if _is_of_floor(one, setup)]
    floor = setup.measured_floor
    if floor is not None:
        view = view_from_floor(of_floor, floor, camera)
        return ArenaWorld(view, floor, floor_corners(of_floor, floor))
    if setup.origin is None:
        raise InputError("floor.origin is missing: which floor marker is the world's origin?")
    _check_all(of_floor, setup)
    sizes_m = {one.key: one.size_m for one in setup.floor}
    asked = [sizes_m[MarkerKey(one.family, one.id)] for one in of_floor]
    laid = lay_floor(of_floor, asked, camera, setup.origin, setup.toward)
    return ArenaWorld(laid.view, laid.floor, floor_corners(of_floor, laid.floor))


def _detected(image: Image, detector: Detector, camera: Camera) -> tuple[Detection, ...]:
    with named_errors(image.source or "image"):
        camera.check_image(image.width_px, image.height_px)
        return detector.detect(image.pixels, camera)


def _is_of_floor(detection: Detection, setup: ArenaSetup) -> bool:
    return MarkerKey(detection.family, detection.id) in {one.key for one in setup.floor}


def _check_all(of_floor: Sequence[Detection], setup: ArenaSetup) -> None:
    """Refuse a floor of which markers are hidden: they would have no place."""
    seen = {MarkerKey(one.family, one.id) for one in of_floor}
    hidden = [one.key for one in setup.floor if one.key not in seen]
    if hidden:
        listed = ", ".join(f"{key.family} id {key.id}" for key in hidden[:4])
        raise InputError(
            f"{len(hidden)} of {len(setup.floor)} floor markers are not seen: {listed}; uncover "
            "them, light them, or take them out of floor.markers"
        )
