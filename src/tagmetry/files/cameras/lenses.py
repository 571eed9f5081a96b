"""The names that files give to lens models."""

from tagmetry.camera import BrownLens, FisheyeLens, Lens
from tagmetry.errors import InputError


def named_lens(
    model: str, coefficients: tuple[float, ...], brown: tuple[str, ...], fisheye: tuple[str, ...]
) -> Lens:
    """Return the lens of a distortion model.

    Args:
        model: The name in the file.
        coefficients: In OpenCV's order.
        brown: The format's names of polynomial distortion.
        fisheye: The format's names of the fisheye model.
    """
    if model in brown:
        return BrownLens(coefficients)
    if model in fisheye:
        return FisheyeLens(coefficients)
    raise InputError(
        f"the distortion model {model!r} is not known; there are {', '.join(brown + fisheye)}"
    )
