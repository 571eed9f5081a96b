"""Whether an image belongs to the intrinsics it comes with."""

from tagmetry.camera import Image
from tagmetry.errors import InputError


def checked_fit(image: Image) -> Image:
    """Return the image, or raise InputError where its camera's intrinsics are for another size."""
    if image.camera is None:
        return image
    try:
        image.camera.check_image(image.width_px, image.height_px)
    except InputError as error:
        raise InputError(f"{image.source}: {error}") from error
    return image
